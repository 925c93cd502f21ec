#include "tests/unit/runtime/native/random_program.h"

#include <bit>
#include <cstring>
#include <utility>

#include "runtime/bytecode/trap.h"
#include "tests/unit/runtime/native/random_expressions.h"

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::FunctionKind;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using writer::FunctionBuilder;

namespace {

class StatementWriter {
 public:
  StatementWriter(FunctionBuilder& builder, const Surroundings& around, std::mt19937& random)
      : b_(builder), around_(around), random_(random), expressions_(builder, around, random) {}

  void statements(int count, int depth) {
    for (int i = 0; i < count; ++i) statement(depth);
  }

 private:
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_() % limit); }

  void statement(int depth) {
    switch (depth > 0 ? below(14) : below(8)) {
      case 0:
        return expressions_.store_indirect();
      case 1:
        expressions_.push(StackType::Bool, 2);
        return b_.store_bit(below(around_.bit_bytes), static_cast<std::uint8_t>(below(8)));
      case 2:
        return copy();
      case 3:
        return call();
      case 4:
        return expressions_.change_string();
      case 5:
        return expressions_.store_by_reference();
      case 8:
      case 9:
        return choice(depth);
      case 10:
      case 11:
      case 12:
        return loop(depth);
      default:
        return assign();
    }
  }

  void assign() {
    if (!around_.locals.empty() && below(4) == 0) {
      const std::uint32_t local = below(static_cast<std::uint32_t>(around_.locals.size()));
      expressions_.push(around_.locals[local], 3);
      return b_.local_set(writer::LocalId(local));
    }
    expressions_.store_variable();
  }

  void copy() {
    static constexpr std::uint32_t kSizes[] = {0, 1, 2, 3, 5, 8, 12, 16, 17, 24, 40, 64, 65, 80};
    expressions_.push_address(96);
    expressions_.push_address(96);
    b_.mem_copy(kSizes[below(std::size(kSizes))]);
  }

  void call() {
    if (around_.callees.empty()) return assign();
    const Callee& callee = around_.callees[below(static_cast<std::uint32_t>(around_.callees.size()))];
    if (callee.kind == FunctionKind::Function) {
      expressions_.call(callee);
      return b_.emit(Opcode::Drop);
    }
    const std::uint32_t base = callee.instances[below(static_cast<std::uint32_t>(callee.instances.size()))];
    switch (below(3)) {
      case 0:
        if (around_.nested_instance != 0 && callee.size <= around_.instance_size - around_.nested_instance) {
          return b_.call_instance(AddressMode::This, callee.index, around_.nested_instance);
        }
        [[fallthrough]];
      case 1:
        return b_.call_instance(AddressMode::Abs, callee.index, base);
      default:
        below(8) == 0 && !around_.careful ? expressions_.push_address(callee.size) : b_.addr_abs(base);
        return b_.call_instance(AddressMode::Ind, callee.index);
    }
  }

  void choice(int depth) {
    const auto otherwise = b_.new_label();
    const auto end = b_.new_label();
    expressions_.push(StackType::Bool, 3);
    below(2) == 0 ? b_.jump_if_false(otherwise) : b_.jump_if_true(otherwise);
    if (below(3) == 0) {
      expressions_.store_leaf();
      return b_.bind(otherwise);
    }
    statements(1 + static_cast<int>(below(3)), depth - 1);
    b_.jump(end);
    b_.bind(otherwise);
    statements(static_cast<int>(below(3)), depth - 1);
    b_.bind(end);
  }

  // Counts in a variable that the body may use and sometimes changes; the budget ends what does not end.
  void loop(int depth) {
    // An address that stays on the stack for all of the loop.
    const bool carries = below(5) == 0;
    if (carries) {
      expressions_.push_address(8);
      ++carried_;
    }
    const std::uint32_t counter =
        around_.counters[below(static_cast<std::uint32_t>(around_.counters.size()))];
    const auto start = b_.new_label();
    const auto exit = b_.new_label();
    b_.const_i32(0);
    b_.store(MemType::I32, AddressMode::This, counter);
    b_.bind(start);
    if (below(3) == 0) {  // no turn, one or two
      b_.load(MemType::I32, AddressMode::This, counter);
      b_.const_i32(static_cast<std::int32_t>(below(3)));
      b_.emit(Opcode::GeI32);
      b_.jump_if_true(exit);
    }
    if (carries) expressions_.store_by_copy_of_address();
    below(3) == 0 ? plain_statements() : statements(1 + static_cast<int>(below(4)), depth - 1);
    if (carries && below(2) == 0) expressions_.store_by_copy_of_address();
    if (below(3) == 0) {
      expressions_.push(StackType::Bool, 2);
      b_.jump_if_true(exit);
    }
    if (below(20) == 0) leave();
    // The test may stand before the step, as the compiler writes it.
    const bool early = below(2) == 0;
    const auto test = [&] {
      b_.load(MemType::I32, AddressMode::This, counter);
      b_.const_i32(static_cast<std::int32_t>(below(6)));
      b_.emit(Opcode::GeI32);
    };
    if (early) test();
    b_.load(MemType::I32, AddressMode::This, counter);
    b_.const_i32(1);
    b_.emit(Opcode::AddI32);
    b_.store(MemType::I32, AddressMode::This, counter);
    if (!early) test();
    if (below(3) != 0) {
      b_.jump_if_false(start);
    } else {
      b_.jump_if_true(exit);
      b_.jump(start);
    }
    b_.bind(exit);
    if (!carries) return;
    b_.emit(Opcode::Drop);
    --carried_;
  }

  // Nothing that keeps a loop from having variables in registers.
  void plain_statements() {
    for (auto i = 2 + below(4); i > 0; --i) {
      switch (below(4)) {
        case 0:
          expressions_.store_indirect();
          break;
        case 1:
          expressions_.store_by_reference();
          break;
        default:
          expressions_.store_leaf();
      }
    }
  }

  void leave() {
    if (carried_ != 0) return;  // the stack would not be empty
    const auto stay = b_.new_label();
    expressions_.push(StackType::Bool, 2);
    b_.jump_if_false(stay);
    if (below(3) == 0 && !around_.careful) {
      b_.trap(static_cast<std::uint8_t>(bytecode::TrapCode::UserTrap));
    } else {
      if (around_.has_result) expressions_.push(around_.result, 2);
      b_.emit(Opcode::Return);
    }
    b_.bind(stay);
  }

  FunctionBuilder& b_;
  const Surroundings& around_;
  std::mt19937& random_;
  ExpressionWriter expressions_;
  int carried_ = 0;  // addresses on the stack below the statement
};

constexpr std::uint32_t kInputs = 8;
constexpr std::uint32_t kAreas = 32;  // inputs, outputs, markers
constexpr std::uint32_t kMainBytes = 512;
constexpr std::uint32_t kBlockBytes = 160;
constexpr std::uint32_t kBlocks = 3;

std::vector<StackType> random_locals(std::mt19937& random) {
  std::vector<StackType> locals;
  for (auto i = random() % 6; i > 0; --i) locals.push_back(static_cast<StackType>(random() % 6));
  return locals;
}

void write_body(FunctionBuilder& builder, Surroundings& around, std::mt19937& random, int statements) {
  around.frame_size = random() % 2 == 0 ? kFrameBytes : 0;
  if (around.frame_size != 0) builder.allocate_frame(kFrameBytes, 4);
  for (std::size_t i = around.parameters; i < around.locals.size(); ++i) builder.add_local(around.locals[i]);
  ExpressionWriter(builder, around, random).init_strings();
  StatementWriter(builder, around, random).statements(statements, 3);
  if (around.has_result) ExpressionWriter(builder, around, random).push(around.result, 3);
  builder.emit(Opcode::Return);
}

writer::Function random_function(std::uint32_t index, std::mt19937& random, Surroundings around,
                                 Callee& callee) {
  FunctionBuilder builder("F", FunctionKind::Function);
  callee = {index, FunctionKind::Function, {}, StackType::I32, 0, {}};
  for (auto i = random() % 4; i > 0; --i) {
    callee.parameters.push_back(static_cast<StackType>(random() % 6));
    builder.add_param(callee.parameters.back());
  }
  callee.result = static_cast<StackType>(random() % 6);
  builder.set_result(callee.result);
  around.instance_size = 0;
  around.locals = callee.parameters;
  around.parameters = callee.parameters.size();
  for (const StackType type : random_locals(random)) around.locals.push_back(type);
  around.has_result = true;
  around.result = callee.result;
  // A function has no instance: it counts nowhere and takes addresses of the image only.
  for (std::size_t i = around.parameters; i < around.locals.size(); ++i) builder.add_local(around.locals[i]);
  around.frame_size = random() % 2 == 0 ? kFrameBytes : 0;
  if (around.frame_size != 0) builder.allocate_frame(kFrameBytes, 4);
  ExpressionWriter expressions(builder, around, random);
  expressions.init_strings();
  for (int i = 0; i < 3; ++i) expressions.store_indirect();
  expressions.push(around.result, 4);
  builder.emit(Opcode::Return);
  return std::move(builder).take();
}

}  // namespace

writer::ContainerModel random_program(std::uint32_t seed) {
  std::mt19937 random(seed);
  writer::ContainerModel model;
  model.sizes = {kInputs, 8, kAreas - kInputs - 8, kMainBytes + kBlocks * kBlockBytes + 16};
  Surroundings around;
  around.image_size = kAreas + model.sizes.data_bytes;
  around.bit_bytes = kAreas;
  around.counters = {0, 4, 8};
  around.careful = random() % 3 != 0;
  std::vector<writer::Function> functions(1);
  if (random() % 2 == 0) {
    Callee callee;
    functions.push_back(random_function(1, random, around, callee));
    around.callees.push_back(callee);
  }
  if (random() % 2 == 0) {
    const auto index = static_cast<std::uint32_t>(functions.size());
    FunctionBuilder block("FB", FunctionKind::FunctionBlock, kBlockBytes);
    Surroundings inner = around;
    inner.instance_size = kBlockBytes;
    inner.first_instance = kAreas + kMainBytes;
    inner.locals = random_locals(random);
    write_body(block, inner, random, 4);
    functions.push_back(std::move(block).take());
    Callee callee{index, FunctionKind::FunctionBlock, {}, StackType::I32, kBlockBytes, {}};
    for (std::uint32_t i = 0; i <= random() % kBlocks; ++i) {
      callee.instances.push_back(kAreas + kMainBytes + i * kBlockBytes);
    }
    around.callees.push_back(callee);
  }
  FunctionBuilder main("MAIN", FunctionKind::Program, kMainBytes);
  around.instance_size = kMainBytes;
  around.first_instance = kAreas;
  around.nested_instance = random() % 2 == 0 ? kMainBytes - kBlockBytes : 0;
  around.locals = random_locals(random);
  write_body(main, around, random, 10);
  functions[0] = std::move(main).take();
  // What traps in those is located at a call.
  for (std::size_t i = 1; i < functions.size(); ++i) functions[i].of_library = (seed >> i) % 2 == 1;
  model.functions = std::move(functions);
  model.initial_data.resize(around.image_size);
  if (random() % 2 == 0) {
    for (std::byte& byte : model.initial_data)
      byte = static_cast<std::byte>(random() % 3 == 0 ? random() : 0);
  }
  model.tasks.push_back(
      {.name = "task", .interval_us = 10'000, .priority = 0, .calls = {{"MAIN", 0, kAreas}}});
  // The same program in a second task: on another instance, with other frames.
  if (random() % 3 == 0) {
    const auto second = kAreas + model.sizes.data_bytes;
    model.sizes.data_bytes += kMainBytes;
    model.initial_data.resize(kAreas + model.sizes.data_bytes);
    model.tasks.push_back(
        {.name = "second", .interval_us = 10'000, .priority = 1, .calls = {{"AGAIN", 0, second}}});
  }
  return model;
}

}  // namespace stepwright::native
