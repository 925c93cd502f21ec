#pragma once

// A container on the host's engines, scan by scan with inputs that are given: what a controller must equal.
//
//   HostMachine host(container, host::EngineKind::Native, budget);
//   const scan::ScanReport report = host.scan(inputs);

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/host/engine_choice.h"
#include "runtime/image/io_driver.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::support {

class HostMachine {
 public:
  // `budget`: of a scan, as the controller has it.
  HostMachine(std::vector<std::byte> container, host::EngineKind kind, std::uint64_t budget)
      : loaded_(load(std::move(container))),
        memory_(loaded_.program().memory_size()),
        image_(memory_, scan::layout_of(loaded_.program())),
        engine_(engine(kind)),
        safe_outputs_(image_.outputs().size()),
        cycle_(loaded_.program(), *engine_, image_, safe_outputs_, io_, clock_, {.budget = budget}) {
    cycle_.start({});
  }

  // Anew, from where a controller stands.
  void start(const scan::StartPoint& at) { cycle_.start(at); }

  scan::ScanReport scan(std::span<const std::byte> inputs) {
    io_.inputs.assign(inputs.begin(), inputs.end());
    return cycle_.run_scan();
  }
  const bytecode::Program& program() const { return loaded_.program(); }
  const scan::ScanCycle& cycle() const { return cycle_; }
  image::ProcessImage& image() { return image_; }

 private:
  struct Terminals final : image::IoDriver {
    image::IoStatus read_inputs(std::int64_t, std::span<std::byte> area) override {
      std::ranges::copy(inputs, area.begin());
      return image::IoStatus::Good;
    }
    image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
      return image::IoStatus::Good;
    }
    std::vector<std::byte> inputs;
  };

  static reader::LoadedProgram load(std::vector<std::byte> container) {
    auto loaded = reader::LoadedProgram::load(std::move(container), "test");
    if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
    return std::move(*loaded);
  }
  std::unique_ptr<bytecode::Engine> engine(host::EngineKind kind) {
    auto made = host::make_engine(kind, loaded_.program());
    if (!made) throw std::runtime_error(result::to_string(made.error()));
    return std::move(*made);
  }

  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  image::ProcessImage image_;
  Terminals io_;
  scan::NoClock clock_;
  std::unique_ptr<bytecode::Engine> engine_;
  std::vector<std::byte> safe_outputs_;
  scan::ScanCycle cycle_;
};

}  // namespace stepwright::support
