#pragma once

// Machine of a replay: an engine, an image and I/O that gives what was recorded. One thread.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/image/io_driver.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::record {

// Gives what was recorded.
class RecordedIo final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> to) override {
    std::copy_n(inputs.begin(), to.size(), to.begin());
    return read_good ? image::IoStatus::Good : image::IoStatus::Lost;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return write_good ? image::IoStatus::Good : image::IoStatus::Lost;
  }

  std::vector<std::byte> inputs;
  bool read_good = true;
  bool write_good = true;
};

struct ReplayMachine {
  ReplayMachine(std::string name, reader::LoadedProgram program, std::unique_ptr<bytecode::Engine> made,
                image::IoDriver& io, scan::Clock& clock, const scan::ScanConfig& config)
      : digest(std::move(name)),
        loaded(std::move(program)),
        memory(loaded.program().memory_size()),
        engine(std::move(made)),
        image(memory, scan::layout_of(loaded.program())),
        safe_outputs(image.outputs().size()),
        cycle(loaded.program(), *engine, image, safe_outputs, io, clock, config) {}

  std::string digest;
  reader::LoadedProgram loaded;
  std::vector<std::byte> memory;
  std::unique_ptr<bytecode::Engine> engine;
  image::ProcessImage image;
  std::vector<std::byte> safe_outputs;
  scan::ScanCycle cycle;
};

}  // namespace stepwright::record
