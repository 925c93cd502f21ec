#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;
using InstId = asmjit::InstId;

namespace {

struct Instructions {
  InstId single_precision;
  InstId double_precision;

  InstId of(StackType type) const { return type == StackType::F32 ? single_precision : double_precision; }
};

constexpr Instructions kAdd{x86::Inst::kIdAddss, x86::Inst::kIdAddsd};
constexpr Instructions kSub{x86::Inst::kIdSubss, x86::Inst::kIdSubsd};
constexpr Instructions kMul{x86::Inst::kIdMulss, x86::Inst::kIdMulsd};
constexpr Instructions kDiv{x86::Inst::kIdDivss, x86::Inst::kIdDivsd};

// The left operand in the register that the result goes to. The order of operands is kept even where it
// seems not to matter: of two NaNs the result is the left one.
RegisterId left_in_result(FunctionWork& work, Value& x, const Value& y) {
  Operands& operands = work.operands();
  const RegisterId target = work.destination(x.type);
  if (target == kNoRegister || y.held() == target) return operands.in_own_register(x);
  operands.into(target, x);
  return target;
}

void binary(FunctionWork& work, const Instructions& instructions, StackType type) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled_beside_flags();
  Value x = operands.pop_settled_beside_flags();
  const RegisterId result = left_in_result(work, x, y);
  work.out().emit(instructions.of(type), xmm(result), operands.float_source(y));
  operands.release(y);
  operands.push(Value::of_register(type, result));
}

void trap_if_zero(FunctionWork& work, Value& y) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  operands.settle_flags();
  const RegisterId divisor = operands.in_register(y);
  const RegisterId zero = operands.allocate(true);
  const asmjit::Label usual = out.newLabel();
  out.xorps(xmm(zero), xmm(zero));
  out.emit(y.type == StackType::F32 ? x86::Inst::kIdUcomiss : x86::Inst::kIdUcomisd, xmm(divisor), xmm(zero));
  out.jp(usual);
  out.je(work.trap(TrapCode::DivisionByZero));
  out.bind(usual);
  operands.registers().release(zero);
}

void divide(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  const std::uint64_t magnitude = type == StackType::F32 ? y.constant << 33 : y.constant << 1;
  if (!y.is(Value::Kind::Constant) || magnitude == 0) trap_if_zero(work, y);
  const RegisterId result = left_in_result(work, x, y);
  work.out().emit(kDiv.of(type), xmm(result), operands.float_source(y));
  operands.release(y);
  operands.push(Value::of_register(type, result));
}

// The sign bit is turned around, also of a NaN.
void negate(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value x = operands.pop_settled_beside_flags();
  const RegisterId result = left_in_result(work, x, {});
  const RegisterId sign = operands.allocate(true);
  out.pcmpeqd(xmm(sign), xmm(sign));
  type == StackType::F32 ? out.pslld(xmm(sign), 31) : out.psllq(xmm(sign), 63);
  out.xorps(xmm(result), xmm(sign));
  operands.registers().release(sign);
  operands.push(Value::of_register(type, result));
}

}  // namespace

bool translate_float(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::AddF32:
      return binary(work, kAdd, StackType::F32), true;
    case Opcode::AddF64:
      return binary(work, kAdd, StackType::F64), true;
    case Opcode::SubF32:
      return binary(work, kSub, StackType::F32), true;
    case Opcode::SubF64:
      return binary(work, kSub, StackType::F64), true;
    case Opcode::MulF32:
      return binary(work, kMul, StackType::F32), true;
    case Opcode::MulF64:
      return binary(work, kMul, StackType::F64), true;
    case Opcode::DivF32:
      return divide(work, StackType::F32), true;
    case Opcode::DivF64:
      return divide(work, StackType::F64), true;
    case Opcode::NegF32:
      return negate(work, StackType::F32), true;
    case Opcode::NegF64:
      return negate(work, StackType::F64), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
