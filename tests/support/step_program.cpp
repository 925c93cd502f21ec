#include "tests/support/step_program.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "runtime/bytecode/trap.h"
#include "runtime/bytecode/writer/container_writer.h"

namespace stepwright::support {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;

constexpr std::uint32_t kMain = StepProgramLayout::kCount;
constexpr std::uint32_t kCount = 0;
constexpr std::uint32_t kStep = StepProgramLayout::kSteps - kMain;

void compare_count(writer::FunctionBuilder& f, std::uint32_t with, Opcode comparison) {
  f.load(MemType::I32, AddressMode::This, kCount);
  f.const_i32(static_cast<std::int32_t>(with));
  f.emit(comparison);
}

writer::Function main_program(const StepProgramOptions& options, std::uint32_t instance_size) {
  const std::uint32_t m = options.scans_per_step;
  writer::FunctionBuilder f("MAIN", bytecode::FunctionKind::Program, instance_size);
  if (options.trap_at_end) {
    const auto go_on = f.new_label();
    f.line(0, 1);
    compare_count(f, options.steps * m, Opcode::LtI32);
    f.jump_if_true(go_on);
    f.line(0, 2);
    f.trap(static_cast<std::uint8_t>(bytecode::TrapCode::UserTrap));
    f.bind(go_on);
  }
  f.line(0, 3);
  for (std::uint32_t k = 0; k < options.steps; ++k) {
    compare_count(f, k * m, Opcode::GeI32);
    if (k + 1 < options.steps) {
      compare_count(f, (k + 1) * m, Opcode::LtI32);
      f.emit(Opcode::AndBool);
    }
    f.store(MemType::Bool, AddressMode::This, kStep + k);
  }
  f.load(MemType::Bool, AddressMode::This, kStep);
  f.store_bit(StepProgramLayout::kOutput, 0);
  f.load(MemType::Bool, AddressMode::This, kStep);
  f.emit(Opcode::NotBool);
  f.store_bit(StepProgramLayout::kOutput, 1);
  f.load(MemType::I32, AddressMode::This, kCount);
  f.const_i32(1);
  f.emit(Opcode::AddI32);
  f.store(MemType::I32, AddressMode::This, kCount);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

}  // namespace

std::vector<std::byte> step_program(const StepProgramOptions& options) {
  writer::ContainerModel model;
  model.sizes.input_bytes = options.input_bytes;
  model.sizes.output_bytes = 1;
  model.sizes.data_bytes = kStep + options.steps;
  model.functions.push_back(main_program(options, model.sizes.data_bytes));
  model.tasks.push_back(
      {.name = "main", .interval_us = options.interval_us, .priority = 0, .calls = {{"MAIN", 0, kMain}}});
  model.source_files.emplace_back("steps.st");
  writer::SfcChart chart{.name = "steps", .steps = {}, .transitions = {}};
  for (std::uint32_t k = 0; k < options.steps; ++k) {
    chart.steps.push_back(
        {"S" + std::to_string(k), "", StepProgramLayout::kSteps + k, bytecode::kNoBit, k == 0});
  }
  for (std::uint32_t k = 0; k + 1 < options.steps; ++k) {
    chart.transitions.push_back(
        {.name = "T" + std::to_string(k), .condition = "", .sources = {k}, .targets = {k + 1}});
  }
  model.charts.push_back(std::move(chart));
  auto bytes = writer::write_container(model);
  if (!bytes) throw std::runtime_error(result::to_string(bytes.error()));
  return std::move(*bytes);
}

}  // namespace stepwright::support
