#include "tests/unit/runtime/native/edge_control.h"

#include <functional>

#include "tests/unit/runtime/native/edge_function.h"

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::FunctionKind;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using writer::FunctionBuilder;

namespace {

using namespace edge_layout;

constexpr StackType kTypes[] = {StackType::Bool, StackType::I32, StackType::I64,
                                StackType::F32,  StackType::F64, StackType::Ref};
constexpr MemType kMemory[] = {MemType::Bool, MemType::I32, MemType::I64,
                               MemType::F32,  MemType::F64, MemType::Ref};

ControlCase make(std::string name, const std::function<void(FunctionBuilder&)>& body,
                 std::vector<writer::Function> callees = {}, std::vector<std::uint32_t> inputs = {0, 1, 2}) {
  ControlCase out{std::move(name), edge_model(), std::move(inputs)};
  FunctionBuilder main("main", FunctionKind::Program, kInstanceBytes);
  main.allocate_frame(kFrameBytes, 8);
  body(main);
  main.emit(Opcode::Return);
  out.model.functions.push_back(std::move(main).take());
  for (writer::Function& each : callees) out.model.functions.push_back(std::move(each));
  writer::Task& task = out.model.tasks.emplace_back();
  task.name = "task";
  task.calls.push_back({"main", 0, kInstances});
  return out;
}

void push_condition(FunctionBuilder& f) {
  f.load(MemType::I32, AddressMode::Abs, kInputs);
  f.const_i32(1);
  f.emit(Opcode::EqI32);
}

// A value of every type stays on the stack over the jump.
ControlCase jump(bool on_true, std::size_t type) {
  return make(on_true ? "JumpIfTrue" : "JumpIfFalse", [=](FunctionBuilder& f) {
    const auto other = f.new_label(), end = f.new_label();
    f.load(kMemory[type], AddressMode::Abs, kOutputs);
    push_condition(f);
    on_true ? f.jump_if_true(other) : f.jump_if_false(other);
    f.store(kMemory[type], AddressMode::Abs, kOutputs + 8);
    f.jump(end);
    f.bind(other);
    f.store(kMemory[type], AddressMode::Abs, kOutputs + 16);
    f.bind(end);
  });
}

// Ends when the input has been counted down, or with the budget.
ControlCase loop(bool at_the_end) {
  return make("loop",
              [=](FunctionBuilder& f) {
                const auto start = f.new_label(), end = f.new_label();
                f.bind(start);
                f.load(MemType::I32, AddressMode::Abs, kInputs);
                f.const_i32(1);
                f.emit(Opcode::SubI32);
                f.store(MemType::I32, AddressMode::Abs, kInputs);
                f.load(MemType::I64, AddressMode::This, 64);
                f.emit(Opcode::Now);
                f.emit(Opcode::AddI64);
                f.store(MemType::I64, AddressMode::This, 64);
                f.load(MemType::I32, AddressMode::Abs, kInputs);
                f.const_i32(0);
                f.emit(Opcode::GtI32);
                if (at_the_end) return f.jump_if_true(start);
                f.jump_if_false(end);
                f.jump(start);
                f.bind(end);
              },
              {}, {0, 1, 5, 100, 0x7FFFFFFF});
}

writer::Function mirror(std::size_t type) {
  FunctionBuilder f("mirror", FunctionKind::Function);
  const auto parameter = f.add_param(kTypes[type]);
  f.set_result(kTypes[type]);
  f.local_get(parameter);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

// An unread load below the call must be what it was before.
ControlCase call(std::size_t type) {
  return make("Call",
              [=](FunctionBuilder& f) {
                f.load(kMemory[type], AddressMode::This, 64);
                f.load(kMemory[type], AddressMode::This, 72);
                f.call(1);
                f.store(kMemory[type], AddressMode::This, 64);
                f.store(kMemory[type], AddressMode::This, 80);
              },
              {mirror(type)});
}

// Adds to the instance, returns early for an input of 2, divides by the input.
writer::Function block() {
  FunctionBuilder f("block", FunctionKind::FunctionBlock, 16);
  const auto on = f.new_label();
  f.load(MemType::I32, AddressMode::This, 0);
  f.const_i32(3);
  f.emit(Opcode::AddI32);
  f.store(MemType::I32, AddressMode::This, 0);
  f.load(MemType::I32, AddressMode::Abs, kInputs);
  f.const_i32(2);
  f.emit(Opcode::NeI32);
  f.jump_if_true(on);
  f.emit(Opcode::Return);
  f.bind(on);
  f.load(MemType::I32, AddressMode::This, 0);
  f.load(MemType::I32, AddressMode::Abs, kInputs);
  f.emit(Opcode::DivI32);
  f.store(MemType::I32, AddressMode::This, 8);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

ControlCase call_instance(AddressMode mode) {
  return make("CallInstance",
              [=](FunctionBuilder& f) {
                f.load(MemType::I32, AddressMode::This, 32);
                f.call_instance(AddressMode::Abs, 1, kSecondInstance);
                if (mode == AddressMode::This) f.call_instance(mode, 1, 32);
                if (mode == AddressMode::Ind) {
                  f.addr_this(32);
                  f.call_instance(mode, 1);
                }
                f.store(MemType::I32, AddressMode::This, 40);
              },
              {block()});
}

// The reference is the input.
ControlCase call_reference() {
  return make("CallInstanceInd",
              [](FunctionBuilder& f) {
                f.load(MemType::Ref, AddressMode::Abs, kInputs);
                f.call_instance(AddressMode::Ind, 1);
              },
              {block()},
              {0, 3, kInstances, kMemoryBytes - 16, kMemoryBytes - 15, kMemoryBytes, 0x7FFFFFFF, 0xFFFFFFFE,
               0xFFFFFFFF});
}

}  // namespace

std::vector<ControlCase> control_cases() {
  std::vector<ControlCase> out;
  for (std::size_t type = 0; type < std::size(kTypes); ++type) {
    for (const bool on_true : {false, true}) out.push_back(jump(on_true, type));
    out.push_back(call(type));
  }
  for (const bool at_the_end : {false, true}) out.push_back(loop(at_the_end));
  for (const AddressMode mode : {AddressMode::Abs, AddressMode::This, AddressMode::Ind})
    out.push_back(call_instance(mode));
  out.push_back(call_reference());
  return out;
}

}  // namespace stepwright::native
