#pragma once

// A program under test with its memory: writes the container from a model, verifies it, runs it. Each run is
// repeated by the quick form of the interpreter on a copy of the memory; std::runtime_error if it differs.
//
//   support::TestProgram program(support::one_program(8, [](auto& f) { f.const_i32(7); f.store(...); }));
//   EXPECT_FALSE(program.run());
//   EXPECT_EQ(program.read<std::int16_t>(0), 7);

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"

namespace stepwright::support {

// One program MAIN with an instance of `data_bytes` at address 0, called by one task of 10 ms. `emit` writes
// its body without the final Return. `more` are functions that it may call: their indexes start at 1.
inline writer::ContainerModel one_program(std::uint32_t data_bytes,
                                          const std::function<void(writer::FunctionBuilder&)>& emit,
                                          std::vector<writer::Function> more = {}) {
  writer::ContainerModel model;
  model.sizes.data_bytes = data_bytes;
  writer::FunctionBuilder main("MAIN", bytecode::FunctionKind::Program, data_bytes);
  emit(main);
  main.emit(bytecode::Opcode::Return);
  model.functions.push_back(std::move(main).take());
  for (writer::Function& function : more) model.functions.push_back(std::move(function));
  model.tasks.push_back({.name = "task", .interval_us = 10'000, .priority = 0, .calls = {{"MAIN", 0, 0}}});
  return model;
}

class TestProgram {
 public:
  explicit TestProgram(const writer::ContainerModel& model)
      : loaded_(load(model)),
        memory_(loaded_.program().memory_size()),
        image_(memory_, scan::layout_of(loaded_.program())),
        stack_(loaded_.program().sizes().stack_slots),
        engine_(loaded_.program(), stack_),
        quick_code_(loaded_.program().container().section(bytecode::Section::Code).size()),
        quick_(loaded_.program(), stack_, quick_code_) {
    image_.reset(loaded_.program().container().section(bytecode::Section::InitialData));
  }
  TestProgram(const TestProgram&) = delete;
  TestProgram& operator=(const TestProgram&) = delete;

  static reader::LoadedProgram load(const writer::ContainerModel& model) {
    auto bytes = writer::write_container(model);
    if (!bytes) throw std::runtime_error(result::to_string(bytes.error()));
    auto loaded = reader::LoadedProgram::load(std::move(*bytes), "test");
    if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
    return std::move(*loaded);
  }

  // One call of the first program call, with a budget that only an endless loop exceeds.
  bytecode::Trap run(std::int64_t now_ns = 0) {
    std::uint64_t budget = 10'000'000;
    return run(now_ns, budget);
  }
  bytecode::Trap run(std::int64_t now_ns, std::uint64_t& budget) {
    const auto call = loaded_.program().container().record<bytecode::Section::ProgramCalls>(0);
    const bytecode::Invocation invocation{call.function, call.instance, now_ns,
                                          loaded_.program().frames_of(0)};
    std::vector<std::byte> copy = memory_;
    std::uint64_t quick_budget = budget;
    const bytecode::Trap quick = quick_.run(invocation, copy, quick_budget);
    const bytecode::Trap trap = engine_.run(invocation, image_.memory(), budget);
    const bool same_trap = trap.code == quick.code && trap.function == quick.function && trap.pc == quick.pc;
    if (!same_trap || budget != quick_budget || copy != memory_)
      throw std::runtime_error("the quick form of the code does something else");
    return trap;
  }

  template <typename T>
  T read(std::uint32_t address) const {
    T value;
    std::memcpy(&value, memory_.data() + address, sizeof(T));
    return value;
  }
  template <typename T>
  void write(std::uint32_t address, T value) {
    std::memcpy(memory_.data() + address, &value, sizeof(T));
  }

  const reader::LoadedProgram& loaded() const { return loaded_; }
  image::ProcessImage& image() { return image_; }
  vm::Interpreter& engine() { return engine_; }

 private:
  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  image::ProcessImage image_;
  std::vector<std::uint64_t> stack_;
  vm::Interpreter engine_;
  std::vector<std::byte> quick_code_;
  vm::Interpreter quick_;
};

}  // namespace stepwright::support
