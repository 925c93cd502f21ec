#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;

namespace {

// The processor takes the count modulo the width; here what is beyond shifts everything out.
void shift(FunctionWork& work, StackType type, bool left) {
  Operands& operands = work.operands();
  Assembler& out = work.out();
  const RegisterId count = operands.pop_register();
  const RegisterId value = operands.pop_register();
  const Gp to = general(value, type);
  left ? out.lsl(to, to, general(count, type)) : out.lsr(to, to, general(count, type));
  out.cmp(w(count), type == StackType::I64 ? 64 : 32);
  const Gp zero = type == StackType::I64 ? static_cast<Gp>(x(Gp::kIdZr)) : static_cast<Gp>(w(Gp::kIdZr));
  out.csel(to, to, zero, CondCode::kLO);
  operands.release(count);
  operands.push_register(type, value);
}

// The lowest 8 or 16 bits, rotated to the left by a count below that.
void rotate_narrow(FunctionWork& work, RegisterId value, RegisterId count, std::uint32_t bits) {
  Assembler& out = work.out();
  const std::uint64_t mask = (1u << bits) - 1;
  out.and_(w(value), w(value), mask);
  out.lsl(w(kScratch), w(value), w(count));
  out.neg(w(count), w(count));
  out.and_(w(count), w(count), bits - 1);
  out.lsr(w(value), w(value), w(count));
  out.orr(w(value), w(value), w(kScratch));
  out.and_(w(value), w(value), mask);
}

void rotate(FunctionWork& work, StackType type, std::uint32_t bits, bool left) {
  Operands& operands = work.operands();
  Assembler& out = work.out();
  const RegisterId count = operands.pop_register();
  const RegisterId value = operands.pop_register();
  if (bits < 32) {
    if (!left) out.neg(w(count), w(count));
    out.and_(w(count), w(count), bits - 1);
    rotate_narrow(work, value, count, bits);
  } else {
    if (left) out.neg(w(count), w(count));
    out.ror(general(value, type), general(value, type), general(count, type));
  }
  operands.release(count);
  operands.push_register(type, value);
}

}  // namespace

bool translate_shift(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::ShlI32:
      return shift(work, StackType::I32, true), true;
    case Opcode::ShlI64:
      return shift(work, StackType::I64, true), true;
    case Opcode::ShrI32:
      return shift(work, StackType::I32, false), true;
    case Opcode::ShrI64:
      return shift(work, StackType::I64, false), true;
    case Opcode::RolI32:
      return rotate(work, StackType::I32, in.a, true), true;
    case Opcode::RolI64:
      return rotate(work, StackType::I64, 64, true), true;
    case Opcode::RorI32:
      return rotate(work, StackType::I32, in.a, false), true;
    case Opcode::RorI64:
      return rotate(work, StackType::I64, 64, false), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
