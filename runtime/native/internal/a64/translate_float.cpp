#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::IntrinsicId;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

enum class Arithmetic { Add, Sub, Mul, Div };

void arithmetic(FunctionWork& work, StackType type, Arithmetic operation) {
  Operands& operands = work.operands();
  Assembler& out = work.out();
  const RegisterId right = operands.pop_register();
  const RegisterId left = operands.pop_register();
  const RegisterId result = operands.allocate(true);
  const Vec x = vector(left, type);
  const Vec y = vector(right, type);
  const Vec to = vector(result, type);
  switch (operation) {
    case Arithmetic::Add:
      out.fadd(to, x, y);
      break;
    case Arithmetic::Sub:
      out.fsub(to, x, y);
      break;
    case Arithmetic::Mul:
      out.fmul(to, x, y);
      break;
    case Arithmetic::Div:
      out.fcmp(y, asmjit::Imm(0.0));
      work.emit().branch(CondCode::kEQ, work.trap(TrapCode::DivisionByZero));
      out.fdiv(to, x, y);
      break;
  }
  work.settle_nan(type, result, left, right);
  operands.release(left);
  operands.release(right);
  operands.push_register(type, result);
}

void negate(FunctionWork& work, StackType type) {
  const RegisterId value = work.operands().pop_register();
  work.out().fneg(vector(value, type), vector(value, type));
  work.operands().push_register(type, value);
}

void absolute_float(FunctionWork& work, StackType type) {
  const RegisterId value = work.operands().pop_register();
  work.out().fabs(vector(value, type), vector(value, type));
  work.operands().push_register(type, value);
}

void square_root(FunctionWork& work, StackType type) {
  const RegisterId value = work.operands().pop_register();
  work.out().fcmp(vector(value, type), asmjit::Imm(0.0));
  work.emit().branch(CondCode::kMI, work.trap(TrapCode::BadArgument));  // not for a NaN
  work.out().fsqrt(vector(value, type), vector(value, type));
  work.operands().push_register(type, value);
}

void absolute_integer(FunctionWork& work, StackType type) {
  const RegisterId value = work.operands().pop_register();
  const Gp to = general(value, type);
  work.out().cmp(to, 0);
  work.out().cneg(to, to, CondCode::kMI);
  work.operands().push_register(type, value);
}

// y where it is less (or greater) than x, else x.
void select_integer(FunctionWork& work, StackType type, CondCode take_y) {
  Operands& operands = work.operands();
  const RegisterId y = operands.pop_register();
  const RegisterId x = operands.pop_register();
  work.out().cmp(general(y, type), general(x, type));
  work.out().csel(general(x, type), general(y, type), general(x, type), take_y);
  operands.release(y);
  operands.push_register(type, x);
}

void select_float(FunctionWork& work, StackType type, CondCode take_y) {
  Operands& operands = work.operands();
  const RegisterId y = operands.pop_register();
  const RegisterId x = operands.pop_register();
  work.out().fcmp(vector(y, type), vector(x, type));
  work.out().fcsel(vector(x, type), vector(y, type), vector(x, type), take_y);
  operands.release(y);
  operands.push_register(type, x);
}

bool intrinsic(FunctionWork& work, IntrinsicId id) {
  using enum StackType;
  using enum CondCode;
  switch (id) {
    case IntrinsicId::AbsI32:
      return absolute_integer(work, I32), true;
    case IntrinsicId::AbsI64:
      return absolute_integer(work, I64), true;
    case IntrinsicId::AbsF32:
      return absolute_float(work, F32), true;
    case IntrinsicId::AbsF64:
      return absolute_float(work, F64), true;
    case IntrinsicId::SqrtF32:
      return square_root(work, F32), true;
    case IntrinsicId::SqrtF64:
      return square_root(work, F64), true;
    case IntrinsicId::MinI32:
      return select_integer(work, I32, kLT), true;
    case IntrinsicId::MinI64:
      return select_integer(work, I64, kLT), true;
    case IntrinsicId::MinU32:
      return select_integer(work, I32, kLO), true;
    case IntrinsicId::MinU64:
      return select_integer(work, I64, kLO), true;
    case IntrinsicId::MaxI32:
      return select_integer(work, I32, kGT), true;
    case IntrinsicId::MaxI64:
      return select_integer(work, I64, kGT), true;
    case IntrinsicId::MaxU32:
      return select_integer(work, I32, kHI), true;
    case IntrinsicId::MaxU64:
      return select_integer(work, I64, kHI), true;
    case IntrinsicId::MinF32:
      return select_float(work, F32, kMI), true;
    case IntrinsicId::MinF64:
      return select_float(work, F64, kMI), true;
    case IntrinsicId::MaxF32:
      return select_float(work, F32, kGT), true;
    case IntrinsicId::MaxF64:
      return select_float(work, F64, kGT), true;
    default:
      return false;
  }
}

}  // namespace

bool translate_float(FunctionWork& work, const Instruction& in) {
  using enum StackType;
  switch (in.opcode) {
    case Opcode::AddF32:
      return arithmetic(work, F32, Arithmetic::Add), true;
    case Opcode::AddF64:
      return arithmetic(work, F64, Arithmetic::Add), true;
    case Opcode::SubF32:
      return arithmetic(work, F32, Arithmetic::Sub), true;
    case Opcode::SubF64:
      return arithmetic(work, F64, Arithmetic::Sub), true;
    case Opcode::MulF32:
      return arithmetic(work, F32, Arithmetic::Mul), true;
    case Opcode::MulF64:
      return arithmetic(work, F64, Arithmetic::Mul), true;
    case Opcode::DivF32:
      return arithmetic(work, F32, Arithmetic::Div), true;
    case Opcode::DivF64:
      return arithmetic(work, F64, Arithmetic::Div), true;
    case Opcode::NegF32:
      return negate(work, F32), true;
    case Opcode::NegF64:
      return negate(work, F64), true;
    case Opcode::Intrinsic:
      return intrinsic(work, static_cast<IntrinsicId>(in.a));
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
