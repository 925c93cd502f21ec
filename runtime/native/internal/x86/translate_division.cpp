#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

struct Division {
  StackType type = StackType::I32;
  bool is_signed = true;
  bool remainder = false;
};

// rdx:rax / divisor, which is neither 0 nor -1.
void divide(FunctionWork& work, const Division& division, x86::Gp divisor) {
  x86::Assembler& out = work.out();
  const x86::Gp high = general(kRdx, divisor.size());
  const x86::Gp low = general(kRax, divisor.size());
  if (!division.is_signed) {
    out.xor_(x86::edx, x86::edx);
    out.div(high, low, divisor);
  } else if (divisor.isGpq()) {
    out.cqo();
    out.idiv(high, low, divisor);
  } else {
    out.cdq();
    out.idiv(high, low, divisor);
  }
}

// The cases that the processor would fault on: a divisor of 0, and the smallest number by -1.
void divide_checked(FunctionWork& work, const Division& division, x86::Gp divisor) {
  x86::Assembler& out = work.out();
  const asmjit::Label done = out.newLabel();
  const asmjit::Label not_zero = out.newLabel();
  const x86::Gp result = general(division.remainder ? kRdx : kRax, divisor.size());
  out.test(divisor, divisor);
  if (division.remainder) {
    out.jnz(not_zero);
    out.xor_(x86::edx, x86::edx);  // x MOD 0 is 0
    out.jmp(done);
    out.bind(not_zero);
  } else {
    out.jz(work.trap(TrapCode::DivisionByZero));
  }
  if (division.is_signed) {
    const asmjit::Label usual = out.newLabel();
    out.cmp(divisor, -1);
    out.jne(usual);
    division.remainder ? out.xor_(x86::edx, x86::edx) : out.neg(result);
    out.jmp(done);
    out.bind(usual);
  }
  divide(work, division, divisor);
  out.bind(done);
}

bool is_harmless(const Value& divisor) {
  if (!divisor.is(Value::Kind::Constant) || divisor.constant == 0) return false;
  return divisor.type == StackType::I32 ? static_cast<std::uint32_t>(divisor.constant) != 0xFFFFFFFF
                                        : divisor.constant != ~std::uint64_t{0};
}

void translate(FunctionWork& work, const Division& division) {
  Operands& operands = work.operands();
  operands.settle_flags();
  operands.claim(kRax);
  operands.claim(kRdx);
  Value y = operands.pop();
  Value x = operands.pop();
  const bool harmless = is_harmless(y);
  const RegisterId divisor = operands.in_register(y);
  operands.into(kRax, x);
  const x86::Gp by = general(divisor, width_of(division.type));
  harmless ? divide(work, division, by) : divide_checked(work, division, by);
  operands.release(y);
  operands.registers().release(division.remainder ? kRax : kRdx);
  operands.push(Value::of_register(division.type, division.remainder ? kRdx : kRax));
}

}  // namespace

bool translate_division(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::DivI32:
      return translate(work, {StackType::I32, true, false}), true;
    case Opcode::DivI64:
      return translate(work, {StackType::I64, true, false}), true;
    case Opcode::DivU32:
      return translate(work, {StackType::I32, false, false}), true;
    case Opcode::DivU64:
      return translate(work, {StackType::I64, false, false}), true;
    case Opcode::ModI32:
      return translate(work, {StackType::I32, true, true}), true;
    case Opcode::ModI64:
      return translate(work, {StackType::I64, true, true}), true;
    case Opcode::ModU32:
      return translate(work, {StackType::I32, false, true}), true;
    case Opcode::ModU64:
      return translate(work, {StackType::I64, false, true}), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
