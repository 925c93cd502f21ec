// Runs containers scan by scan on pseudo-random inputs and prints, for each, what every machine and engine
// must agree on: `engine_trace vm|native FILE...` -> "NAME scans trace-hash trap".

#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <string_view>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/image/process_image.h"
#include "runtime/native/native_engine.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"

namespace stepwright {
namespace {

constexpr std::uint64_t kScans = 25;

class RandomInputs final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    for (std::byte& byte : inputs) byte = static_cast<std::byte>(random_());
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return image::IoStatus::Good;
  }

 private:
  std::mt19937 random_{1};
};

result::Result<std::unique_ptr<bytecode::Engine>> make_engine(const bytecode::Program& program, bool native,
                                                              std::vector<std::uint64_t>& stack) {
  if (!native) return std::make_unique<vm::Interpreter>(program, stack);
  auto engine = native::NativeEngine::compile(program);
  if (!engine) return result::forward(engine);
  return std::unique_ptr<bytecode::Engine>(std::move(*engine));
}

result::Result<void> trace(const char* file, bool native) {
  auto loaded = reader::LoadedProgram::load_file(file);
  if (!loaded) return result::forward(loaded);
  const bytecode::Program& program = loaded->program();
  std::vector<std::byte> memory(program.memory_size());
  std::vector<std::uint64_t> stack(program.sizes().stack_slots);
  image::ProcessImage image(memory, scan::layout_of(program));
  auto engine = make_engine(program, native, stack);
  if (!engine) return result::forward(engine);
  RandomInputs io;
  scan::NoClock clock;
  std::vector<std::byte> safe_outputs(image.outputs().size());
  scan::ScanCycle cycle(program, **engine, image, safe_outputs, io, clock, {.budget = 200'000});
  cycle.start({});
  bytecode::Trap trap;
  std::uint64_t scans = 0;
  while (scans < kScans && cycle.state() == scan::ScanState::Running) {
    const scan::ScanReport report = cycle.run_scan();
    scans = report.scan;
    trap = report.trap;
  }
  std::printf("%s %llu %016llx %u:%u:%u\n", std::filesystem::path(file).stem().c_str(),
              static_cast<unsigned long long>(scans), static_cast<unsigned long long>(cycle.trace_hash()),
              static_cast<unsigned>(trap.code), trap.function, trap.pc);
  return {};
}

}  // namespace
}  // namespace stepwright

int main(int count, char** arguments) {
  if (count < 3) return 2;
  const bool native = std::string_view(arguments[1]) == "native";
  for (int i = 2; i < count; ++i) {
    if (auto traced = stepwright::trace(arguments[i], native); !traced) {
      std::fprintf(stderr, "%s: %s\n", arguments[i], stepwright::result::to_string(traced.error()).c_str());
      return 1;
    }
  }
}
