#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using asmjit::x86::CondCode;
using bytecode::Instruction;
using bytecode::IntrinsicId;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

void absolute_integer(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const std::uint32_t bytes = width_of(type);
  const RegisterId from = operands.in_register(x);
  const RegisterId result = operands.allocate(false);
  work.out().mov(general(result, bytes), general(from, bytes));
  work.out().neg(general(result, bytes));
  work.out().cmovs(general(result, bytes), general(from, bytes));  // it was positive, or the smallest
  operands.release(x);
  operands.push(Value::of_register(type, result));
}

void absolute_float(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value x = operands.pop_settled_beside_flags();
  const RegisterId reg = operands.in_own_register(x);
  if (type == StackType::F32) {
    out.pslld(xmm(reg), 1);
    out.psrld(xmm(reg), 1);
  } else {
    out.psllq(xmm(reg), 1);
    out.psrlq(xmm(reg), 1);
  }
  operands.push(x);
}

void square_root(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const bool single_precision = type == StackType::F32;
  const RegisterId from = operands.in_register(x);
  const RegisterId result = operands.allocate(true);
  out.xorps(xmm(result), xmm(result));
  single_precision ? out.ucomiss(xmm(result), xmm(from)) : out.ucomisd(xmm(result), xmm(from));
  out.ja(work.trap(TrapCode::BadArgument));  // not for a NaN
  single_precision ? out.sqrtss(xmm(result), xmm(from)) : out.sqrtsd(xmm(result), xmm(from));
  operands.release(x);
  operands.push(Value::of_register(type, result));
}

// x, unless y is less (or greater).
void select_integer(FunctionWork& work, StackType type, CondCode take_y) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const std::uint32_t bytes = width_of(type);
  const RegisterId right = operands.in_register(y);
  const RegisterId result = operands.in_own_register(x);
  work.out().cmp(general(right, bytes), general(result, bytes));
  work.out().cmov(take_y, general(result, bytes), general(right, bytes));
  operands.release(y);
  operands.push(x);
}

// The instruction gives its second operand, here x, where the two compare neither way.
void select_float(FunctionWork& work, StackType type, asmjit::InstId instruction) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled_beside_flags();
  Value x = operands.pop_settled_beside_flags();
  const RegisterId result = operands.in_own_register(y);
  work.out().emit(instruction, xmm(result), operands.float_source(x));
  operands.release(x);
  operands.push(Value::of_register(type, result));
}

}  // namespace

bool translate_intrinsic(FunctionWork& work, const Instruction& in) {
  if (in.opcode != Opcode::Intrinsic) return false;
  namespace Inst = x86::Inst;
  switch (static_cast<IntrinsicId>(in.a)) {
    case IntrinsicId::AbsI32:
      return absolute_integer(work, StackType::I32), true;
    case IntrinsicId::AbsI64:
      return absolute_integer(work, StackType::I64), true;
    case IntrinsicId::AbsF32:
      return absolute_float(work, StackType::F32), true;
    case IntrinsicId::AbsF64:
      return absolute_float(work, StackType::F64), true;
    case IntrinsicId::SqrtF32:
      return square_root(work, StackType::F32), true;
    case IntrinsicId::SqrtF64:
      return square_root(work, StackType::F64), true;
    case IntrinsicId::MinI32:
      return select_integer(work, StackType::I32, CondCode::kSignedLT), true;
    case IntrinsicId::MinI64:
      return select_integer(work, StackType::I64, CondCode::kSignedLT), true;
    case IntrinsicId::MinU32:
      return select_integer(work, StackType::I32, CondCode::kUnsignedLT), true;
    case IntrinsicId::MinU64:
      return select_integer(work, StackType::I64, CondCode::kUnsignedLT), true;
    case IntrinsicId::MaxI32:
      return select_integer(work, StackType::I32, CondCode::kSignedGT), true;
    case IntrinsicId::MaxI64:
      return select_integer(work, StackType::I64, CondCode::kSignedGT), true;
    case IntrinsicId::MaxU32:
      return select_integer(work, StackType::I32, CondCode::kUnsignedGT), true;
    case IntrinsicId::MaxU64:
      return select_integer(work, StackType::I64, CondCode::kUnsignedGT), true;
    case IntrinsicId::MinF32:
      return select_float(work, StackType::F32, Inst::kIdMinss), true;
    case IntrinsicId::MinF64:
      return select_float(work, StackType::F64, Inst::kIdMinsd), true;
    case IntrinsicId::MaxF32:
      return select_float(work, StackType::F32, Inst::kIdMaxss), true;
    case IntrinsicId::MaxF64:
      return select_float(work, StackType::F64, Inst::kIdMaxsd), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
