#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::StackType;
namespace x86 = asmjit::x86;
using InstId = asmjit::InstId;

namespace {

// A count of the width or more shifts everything out.
void shift(FunctionWork& work, InstId instruction, StackType type) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  operands.settle_flags();
  const std::uint32_t bytes = width_of(type);
  const std::uint32_t bits = bytes * 8;
  if (operands.at(operands.depth() - 1).is(Value::Kind::Constant)) {
    const auto count = static_cast<std::uint32_t>(operands.pop().constant);
    Value x = operands.pop();
    if (count >= bits) {
      operands.release(x);
      return operands.push(Value::of_constant(type, 0));
    }
    const RegisterId reg = operands.in_own_register(x);
    if (count != 0) out.emit(instruction, general(reg, bytes), asmjit::Imm(count));
    return operands.push(x);
  }
  operands.claim(kRcx);
  Value count = operands.pop();
  Value x = operands.pop();
  operands.into(kRcx, count);
  const RegisterId reg = operands.in_own_register(x);
  out.emit(instruction, general(reg, bytes), x86::cl);
  out.cmp(x86::ecx, bits);
  out.sbb(gp64(kScratch), gp64(kScratch));  // all ones below the width, else zero
  out.and_(general(reg, bytes), general(kScratch, bytes));
  operands.release(count);
  operands.push(x);
}

// The count is taken modulo the width, which the instruction does itself.
void rotate(FunctionWork& work, InstId instruction, StackType type, std::uint32_t bits) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  operands.settle_flags();
  operands.claim(kRcx);
  Value count = operands.pop();
  Value x = operands.pop();
  operands.into(kRcx, count);
  const RegisterId reg = operands.in_own_register(x);
  out.emit(instruction, general(reg, bits / 8), x86::cl);
  if (bits < 32) out.movzx(gp32(reg), general(reg, bits / 8));
  operands.release(count);
  operands.push(Value::of_register(type, reg));
}

}  // namespace

bool translate_shift(FunctionWork& work, const Instruction& in) {
  namespace Inst = x86::Inst;
  switch (in.opcode) {
    case Opcode::ShlI32:
      return shift(work, Inst::kIdShl, StackType::I32), true;
    case Opcode::ShlI64:
      return shift(work, Inst::kIdShl, StackType::I64), true;
    case Opcode::ShrI32:
      return shift(work, Inst::kIdShr, StackType::I32), true;
    case Opcode::ShrI64:
      return shift(work, Inst::kIdShr, StackType::I64), true;
    case Opcode::RolI32:
      return rotate(work, Inst::kIdRol, StackType::I32, in.a), true;
    case Opcode::RolI64:
      return rotate(work, Inst::kIdRol, StackType::I64, 64), true;
    case Opcode::RorI32:
      return rotate(work, Inst::kIdRor, StackType::I32, in.a), true;
    case Opcode::RorI64:
      return rotate(work, Inst::kIdRor, StackType::I64, 64), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
