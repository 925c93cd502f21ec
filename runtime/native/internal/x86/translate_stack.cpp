#include <cstring>

#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
namespace x86 = asmjit::x86;

namespace {

void duplicate(FunctionWork& work) {
  Operands& operands = work.operands();
  Value top = operands.pop_settled();
  // A load may come from the operand's own slot, which the copy does not own.
  if (top.is(Value::Kind::Load)) operands.in_register(top);
  const RegisterId held = top.held();
  if (held != kNoRegister && !operands.registers().pinned(held)) operands.registers().retain(held);
  operands.push(top);
  operands.push(top);
}

// The bits of a floating-point value in a general register of its own.
RegisterId general_bits(FunctionWork& work, Value& value) {
  Operands& operands = work.operands();
  const std::uint32_t bytes = width_of(value.type);
  const StackType as = bytes == 4 ? StackType::I32 : StackType::I64;
  if (value.is(Value::Kind::Constant) || (value.is(Value::Kind::Load) && value.location.fixed())) {
    value.type = as;
    value.memory = slot_memory(as);
    return operands.in_own_register(value);
  }
  const RegisterId from = operands.in_register(value);
  const RegisterId to = operands.allocate(false);
  bytes == 4 ? work.out().movd(gp32(to), xmm(from)) : work.out().movq(gp64(to), xmm(from));
  operands.release(value);
  value = Value::of_register(as, to);
  return to;
}

void test_bool(FunctionWork& work, Value& condition) {
  const RegisterId reg = work.operands().in_register(condition);
  work.out().test(gp8(reg), gp8(reg));
}

// x, y, condition: y if TRUE, without a branch.
void select(FunctionWork& work) {
  Operands& operands = work.operands();
  Value condition = operands.pop_settled();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const StackType type = x.type;
  const bool floating = is_float(type);
  const RegisterId result = floating ? general_bits(work, x) : operands.in_own_register(x);
  const RegisterId other = floating ? general_bits(work, y) : operands.in_register(y);
  test_bool(work, condition);
  const std::uint32_t bytes = width_of(type) == 8 ? 8 : 4;
  work.out().cmovnz(general(result, bytes), general(other, bytes));
  operands.release(condition);
  operands.release(y);
  if (!floating) return operands.push(Value::of_register(type, result));
  const RegisterId target = operands.allocate(true);
  bytes == 4 ? work.out().movd(xmm(target), gp32(result)) : work.out().movq(xmm(target), gp64(result));
  operands.release(x);
  operands.push(Value::of_register(type, target));
}

std::uint64_t wide_constant(FunctionWork& work, std::uint32_t index) {
  return work.view().record<bytecode::Section::Constants>(index);
}

}  // namespace

bool translate_stack(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  switch (in.opcode) {
    case Opcode::ConstBool:
      return operands.push(Value::of_constant(StackType::Bool, in.a)), true;
    case Opcode::ConstI32:
      return operands.push(Value::of_constant(StackType::I32, in.a)), true;
    case Opcode::ConstF32:
      return operands.push(Value::of_constant(StackType::F32, in.a)), true;
    case Opcode::ConstI64:
      return operands.push(Value::of_constant(StackType::I64, wide_constant(work, in.a))), true;
    case Opcode::ConstF64:
      return operands.push(Value::of_constant(StackType::F64, wide_constant(work, in.a))), true;
    case Opcode::ConstNull:
      return operands.push(Value::of_constant(StackType::Ref, bytecode::kNullRef)), true;
    case Opcode::Now: {
      const Location now{Space::Slot, offsetof(Context, now_ns), kNoRegister, 0};
      return operands.push(Value::of_load(MemType::I64, now)), true;
    }
    case Opcode::Dup:
      return duplicate(work), true;
    case Opcode::Drop:
      return operands.release(operands.pop()), true;
    case Opcode::Select:
      return select(work), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
