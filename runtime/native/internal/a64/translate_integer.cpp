#include <utility>

#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

// The number if it fits into an instruction as it is.
bool is_small(const Operand& operand) {
  return operand.is(Operand::Kind::Constant) && operand.constant < 4096;
}

void add(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  Operand y = operands.pop();
  Operand x = operands.pop();
  if (is_small(x)) std::swap(x, y);
  const RegisterId sum = operands.in_register(x);
  const Gp to = general(sum, type);
  if (is_small(y)) {
    work.out().add(to, to, y.constant);
  } else {
    const RegisterId other = operands.in_register(y);
    work.out().add(to, to, general(other, type));
    operands.release(other);
  }
  operands.push_register(type, sum);
}

void subtract(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  Operand y = operands.pop();
  Operand x = operands.pop();
  const RegisterId difference = operands.in_register(x);
  const Gp to = general(difference, type);
  if (is_small(y)) {
    work.out().sub(to, to, y.constant);
  } else {
    const RegisterId other = operands.in_register(y);
    work.out().sub(to, to, general(other, type));
    operands.release(other);
  }
  operands.push_register(type, difference);
}

void multiply(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  const RegisterId y = operands.pop_register();
  const RegisterId x = operands.pop_register();
  work.out().mul(general(x, type), general(x, type), general(y, type));
  operands.release(y);
  operands.push_register(type, x);
}

struct Division {
  StackType type = StackType::I32;
  bool is_signed = true;
  bool remainder = false;
};

// The processor divides by 0 without a fault, and the smallest number by -1 to itself.
void divide(FunctionWork& work, const Division& division) {
  Operands& operands = work.operands();
  Assembler& out = work.out();
  const RegisterId divisor = operands.pop_register();
  const RegisterId number = operands.pop_register();
  const Gp y = general(divisor, division.type);
  const Gp x = general(number, division.type);
  out.cmp(y, 0);
  if (!division.remainder) {
    work.emit().branch(CondCode::kEQ, work.trap(TrapCode::DivisionByZero));
    division.is_signed ? out.sdiv(x, x, y) : out.udiv(x, x, y);
  } else {
    const Gp quotient = general(kScratch, division.type);
    division.is_signed ? out.sdiv(quotient, x, y) : out.udiv(quotient, x, y);
    out.msub(x, quotient, y, x);
    out.csel(x, y, x, CondCode::kEQ);  // x MOD 0 is 0
  }
  operands.release(divisor);
  operands.push_register(division.type, number);
}

void negate(FunctionWork& work, StackType type) {
  const RegisterId value = work.operands().pop_register();
  work.out().neg(general(value, type), general(value, type));
  work.operands().push_register(type, value);
}

void wrap(FunctionWork& work, Opcode opcode) {
  Assembler& out = work.out();
  const RegisterId value = work.operands().pop_register();
  if (opcode == Opcode::WrapI8) out.sxtb(w(value), w(value));
  if (opcode == Opcode::WrapU8) out.uxtb(w(value), w(value));
  if (opcode == Opcode::WrapI16) out.sxth(w(value), w(value));
  if (opcode == Opcode::WrapU16) out.uxth(w(value), w(value));
  work.operands().push_register(StackType::I32, value);
}

}  // namespace

bool translate_integer(FunctionWork& work, const Instruction& in) {
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
    case Opcode::DivI32:
      return divide(work, {StackType::I32, true, false}), true;
    case Opcode::DivI64:
      return divide(work, {StackType::I64, true, false}), true;
    case Opcode::DivU32:
      return divide(work, {StackType::I32, false, false}), true;
    case Opcode::DivU64:
      return divide(work, {StackType::I64, false, false}), true;
    case Opcode::ModI32:
      return divide(work, {StackType::I32, true, true}), true;
    case Opcode::ModI64:
      return divide(work, {StackType::I64, true, true}), true;
    case Opcode::ModU32:
      return divide(work, {StackType::I32, false, true}), true;
    case Opcode::ModU64:
      return divide(work, {StackType::I64, false, true}), true;
    case Opcode::NegI32:
      return negate(work, StackType::I32), true;
    case Opcode::NegI64:
      return negate(work, StackType::I64), true;
    case Opcode::WrapI8:
    case Opcode::WrapU8:
    case Opcode::WrapI16:
    case Opcode::WrapU16:
      return wrap(work, in.opcode), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
