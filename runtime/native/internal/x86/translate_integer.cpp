#include <limits>
#include <utility>

#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
namespace x86 = asmjit::x86;
using InstId = asmjit::InstId;

namespace {

bool is_own(FunctionWork& work, const Value& value) {
  const Registers& registers = work.operands().registers();
  return value.is(Value::Kind::Register) && !registers.pinned(value.reg) && registers.uses(value.reg) == 1;
}

bool is_small(const Value& value) {
  const auto wide = static_cast<std::int64_t>(value.constant);
  return value.is(Value::Kind::Constant) &&
         (value.type != StackType::I64 || (wide > std::numeric_limits<std::int32_t>::min() &&
                                           wide <= std::numeric_limits<std::int32_t>::max()));
}

// The left operand in the register that the result goes to.
RegisterId left_in_result(FunctionWork& work, Value& x, const Value& y) {
  Operands& operands = work.operands();
  const RegisterId target = work.destination(x.type);
  if (target == kNoRegister || y.held() == target) return operands.in_own_register(x);
  operands.into(target, x);
  return target;
}

void binary(FunctionWork& work, InstId instruction, StackType type, bool commutative) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const RegisterId target = work.destination(type);
  const bool y_in_target = target != kNoRegister && y.is(Value::Kind::Register) && y.reg == target;
  if (commutative && (y_in_target || (!is_own(work, x) && is_own(work, y)) ||
                      (x.is(Value::Kind::Constant) && !y.is(Value::Kind::Constant)))) {
    std::swap(x, y);
  }
  const std::uint32_t bytes = width_of(type);
  const RegisterId result = left_in_result(work, x, y);
  work.out().emit(instruction, general(result, bytes), operands.source(y, bytes));
  operands.release(y);
  operands.push(Value::of_register(type, result));
}

// x + constant without a copy, and without the flags where they are still needed.
void add_constant(FunctionWork& work, StackType type, std::int32_t constant) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled_beside_flags();
  const RegisterId from = operands.in_register(x);
  const std::uint32_t bytes = width_of(type);
  RegisterId result = work.destination(type);
  if (result == kNoRegister && is_own(work, x)) {
    result = from;
    operands.registers().forget(result);
  } else {
    if (result == kNoRegister) result = operands.allocate(false);
    operands.release(x);
  }
  if (result == from && !operands.flags_pending()) {
    work.out().add(general(result, bytes), constant);
  } else {
    work.out().lea(general(result, bytes), x86::ptr(gp64(from), constant));
  }
  operands.push(Value::of_register(type, result));
}

bool add_or_subtract_constant(FunctionWork& work, StackType type, bool subtract) {
  Operands& operands = work.operands();
  if (!is_small(operands.at(operands.depth() - 1))) return false;
  const Value y = operands.pop();
  const auto constant = static_cast<std::uint32_t>(y.constant);
  add_constant(work, type, static_cast<std::int32_t>(subtract ? 0u - constant : constant));
  return true;
}

void add(FunctionWork& work, StackType type) {
  if (!add_or_subtract_constant(work, type, false)) binary(work, x86::Inst::kIdAdd, type, true);
}

void subtract(FunctionWork& work, StackType type) {
  if (!add_or_subtract_constant(work, type, true)) binary(work, x86::Inst::kIdSub, type, false);
}

void multiply(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  if (!is_small(operands.at(operands.depth() - 1))) return binary(work, x86::Inst::kIdImul, type, true);
  const Value y = operands.pop();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const std::uint32_t bytes = width_of(type);
  const RegisterId from = operands.in_register(x);
  RegisterId result = work.destination(type);
  if (result == kNoRegister) result = operands.allocate(false);
  work.out().imul(general(result, bytes), general(from, bytes), static_cast<std::int32_t>(y.constant));
  operands.release(x);
  operands.push(Value::of_register(type, result));
}

void unary(FunctionWork& work, InstId instruction, StackType type) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const RegisterId result = left_in_result(work, x, {});
  work.out().emit(instruction, general(result, width_of(type)));
  operands.push(Value::of_register(type, result));
}

// The lowest bytes, extended again.
void wrap(FunctionWork& work, std::uint32_t bytes, bool is_signed) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  const RegisterId from = operands.in_register(x);
  RegisterId result = work.destination(StackType::I32);
  if (result == kNoRegister && is_own(work, x)) {
    result = from;
    operands.registers().forget(result);
  } else {
    if (result == kNoRegister) result = operands.allocate(false);
    operands.release(x);
  }
  is_signed ? work.out().movsx(gp32(result), general(from, bytes))
            : work.out().movzx(gp32(result), general(from, bytes));
  operands.push(Value::of_register(StackType::I32, result));
}

// Costs nothing where the value is not read yet or is still in the flags.
void not_bool(FunctionWork& work) {
  Operands& operands = work.operands();
  Value& top = operands.at(operands.depth() - 1);
  if (top.is(Value::Kind::Flags)) {
    top.condition = x86::negateCond(top.condition);
  } else if (top.is(Value::Kind::Load)) {
    top.inverted = !top.inverted;
  } else if (top.is(Value::Kind::Constant)) {
    top.constant ^= 1;
  } else {
    Value x = operands.pop();
    operands.settle_flags();
    const RegisterId result = left_in_result(work, x, {});
    work.out().xor_(gp8(result), 1);
    operands.push(Value::of_register(StackType::Bool, result));
  }
}

// A load, perhaps inverted, and the operation behind it.
void fused(FunctionWork& work, const Instruction& in) {
  const bool own = bytecode::is_this_boolean(in.opcode);
  push_load(work, own ? work.of_self(in.a) : work.absolute(in.a), work.effect(false), StackType::Bool);
  switch (in.opcode) {
    case Opcode::LoadNotBoolAbs:
    case Opcode::LoadNotBoolThis:
      return not_bool(work);
    case Opcode::AndNotBoolAbs:
    case Opcode::AndNotBoolThis:
      not_bool(work);
      [[fallthrough]];
    case Opcode::AndBoolAbs:
    case Opcode::AndBoolThis:
      return binary(work, x86::Inst::kIdAnd, StackType::Bool, true);
    case Opcode::OrNotBoolAbs:
    case Opcode::OrNotBoolThis:
      not_bool(work);
      [[fallthrough]];
    case Opcode::OrBoolAbs:
    case Opcode::OrBoolThis:
      return binary(work, x86::Inst::kIdOr, StackType::Bool, true);
    default:
      return binary(work, x86::Inst::kIdXor, StackType::Bool, true);
  }
}

}  // namespace

bool translate_integer(FunctionWork& work, const Instruction& in) {
  namespace Inst = x86::Inst;
  if (bytecode::is_fused_boolean(in.opcode)) return fused(work, in), true;
  switch (in.opcode) {
    case Opcode::AddI32:
      return add(work, StackType::I32), true;
    case Opcode::AddI64:
      return add(work, StackType::I64), true;
    case Opcode::SubI32:
      return subtract(work, StackType::I32), true;
    case Opcode::SubI64:
      return subtract(work, StackType::I64), true;
    case Opcode::MulI32:
      return multiply(work, StackType::I32), true;
    case Opcode::MulI64:
      return multiply(work, StackType::I64), true;
    case Opcode::NegI32:
      return unary(work, Inst::kIdNeg, StackType::I32), true;
    case Opcode::NegI64:
      return unary(work, Inst::kIdNeg, StackType::I64), true;
    case Opcode::NotI32:
      return unary(work, Inst::kIdNot, StackType::I32), true;
    case Opcode::NotI64:
      return unary(work, Inst::kIdNot, StackType::I64), true;
    case Opcode::AndBool:
      return binary(work, Inst::kIdAnd, StackType::Bool, true), true;
    case Opcode::OrBool:
      return binary(work, Inst::kIdOr, StackType::Bool, true), true;
    case Opcode::XorBool:
      return binary(work, Inst::kIdXor, StackType::Bool, true), true;
    case Opcode::AndI32:
      return binary(work, Inst::kIdAnd, StackType::I32, true), true;
    case Opcode::AndI64:
      return binary(work, Inst::kIdAnd, StackType::I64, true), true;
    case Opcode::OrI32:
      return binary(work, Inst::kIdOr, StackType::I32, true), true;
    case Opcode::OrI64:
      return binary(work, Inst::kIdOr, StackType::I64, true), true;
    case Opcode::XorI32:
      return binary(work, Inst::kIdXor, StackType::I32, true), true;
    case Opcode::XorI64:
      return binary(work, Inst::kIdXor, StackType::I64, true), true;
    case Opcode::NotBool:
      return not_bool(work), true;
    case Opcode::WrapI8:
      return wrap(work, 1, true), true;
    case Opcode::WrapU8:
      return wrap(work, 1, false), true;
    case Opcode::WrapI16:
      return wrap(work, 2, true), true;
    case Opcode::WrapU16:
      return wrap(work, 2, false), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
