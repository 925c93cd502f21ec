#pragma once

// Sources compiled and run scan by scan, without I/O; variables by their path.
//
//   support::CompiledProgram program(input);
//   program.set("main.go", 1);
//   program.scan();
//   EXPECT_EQ(program.get("main.lamp"), 1);

#include <cstring>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/image/no_io.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::support {

class CompiledProgram {
 public:
  // Throws std::runtime_error with the diagnostics if the input is wrong.
  explicit CompiledProgram(const driver::CompileInput& input)
      : loaded_(load(input)),
        info_(reader::ProgramInfo::read(loaded_.bytes()).value()),
        memory_(loaded_.program().memory_size()),
        stack_(loaded_.program().sizes().stack_slots),
        image_(memory_, scan::layout_of(loaded_.program())),
        engine_(loaded_.program(), stack_),
        safe_outputs_(image_.outputs().size()),
        cycle_(loaded_.program(), engine_, image_, safe_outputs_, io_, clock_, {}) {
    cycle_.start({});
  }
  CompiledProgram(const CompiledProgram&) = delete;
  CompiledProgram& operator=(const CompiledProgram&) = delete;

  scan::ScanReport scan() { return cycle_.run_scan(); }

  // Starts again, as if scans had run until then.
  void start_at(std::int64_t time_ns) { cycle_.start({.time_ns = time_ns}); }

  reader::Value value(const std::string& path) const { return reader::read_value(find(path), memory_); }

  // As a person writes it: an enumerator by its name, D#2026-11-21.
  std::string text(const std::string& path) const { return reader::read_text(find(path), memory_); }

  // Integers, BOOL as 0 and 1. Throws for a string.
  std::int64_t get(const std::string& path) const {
    return std::visit(
        [](const auto& plain) -> std::int64_t {
          if constexpr (std::is_same_v<std::decay_t<decltype(plain)>, std::string>) {
            throw std::runtime_error("not a number: " + plain);
          } else {
            return static_cast<std::int64_t>(plain);
          }
        },
        value(path));
  }

  // The low bytes of the value; a located BOOL as its bit.
  void set(const std::string& path, std::int64_t value) {
    const reader::Variable variable = find(path);
    std::byte* target = memory_.data() + variable.address;
    if (variable.bit == bytecode::kNoBit) {
      std::memcpy(target, &value, bytecode::size_of(bytecode::mem_type(variable.type)));
      return;
    }
    const std::byte mask = std::byte{1} << variable.bit;
    *target = value != 0 ? *target | mask : *target & ~mask;
  }

  reader::Variable find(const std::string& path) const {
    const reader::Variable* variable = info_.find(path);
    if (variable == nullptr) throw std::runtime_error("no variable " + path);
    return *variable;
  }

  const reader::LoadedProgram& loaded() const { return loaded_; }
  image::ProcessImage& image() { return image_; }

 private:
  static reader::LoadedProgram load(const driver::CompileInput& input) {
    auto output = driver::compile(input);
    if (!output) throw std::runtime_error(result::to_string(output.error()));
    auto loaded = reader::LoadedProgram::load(std::move(output->container), "test");
    if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
    return std::move(*loaded);
  }

  reader::LoadedProgram loaded_;
  reader::ProgramInfo info_;
  std::vector<std::byte> memory_;
  std::vector<std::uint64_t> stack_;
  image::ProcessImage image_;
  vm::Interpreter engine_;
  std::vector<std::byte> safe_outputs_;
  image::NoIo io_;
  scan::NoClock clock_;
  scan::ScanCycle cycle_;
};

}  // namespace stepwright::support
