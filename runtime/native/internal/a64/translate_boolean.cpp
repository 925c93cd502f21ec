#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;

namespace {

// A BOOL in memory, as the second operand of an instruction.
RegisterId load_operand(FunctionWork& work, const Instruction& in) {
  const bool own = bytecode::is_this_boolean(in.opcode);
  const RegisterId to = work.operands().allocate(false);
  const Mem byte = own ? work.of_self(in.a, 1) : work.absolute(in.a, 1);
  work.emit().load(to, MemType::Bool, byte, work.reads_plain_bool());
  return to;
}

void load_inverted(FunctionWork& work, const Instruction& in) {
  const RegisterId value = load_operand(work, in);
  work.out().eor(w(value), w(value), 1);
  work.operands().push_register(StackType::Bool, value);
}

enum class Logic { And, Or, Xor, AndNot, OrNot };

void combine(FunctionWork& work, Logic logic, RegisterId to, RegisterId from, bool wide) {
  Assembler& out = work.out();
  const Gp a = wide ? static_cast<Gp>(x(to)) : static_cast<Gp>(w(to));
  const Gp b = wide ? static_cast<Gp>(x(from)) : static_cast<Gp>(w(from));
  switch (logic) {
    case Logic::And:
      out.and_(a, a, b);
      return;
    case Logic::Or:
      out.orr(a, a, b);
      return;
    case Logic::Xor:
      out.eor(a, a, b);
      return;
    case Logic::AndNot:  // of BOOLs
      out.bic(a, a, b);
      return;
    case Logic::OrNot:
      out.eor(b, b, 1);
      out.orr(a, a, b);
      return;
  }
}

void with_memory(FunctionWork& work, Logic logic, const Instruction& in) {
  Operands& operands = work.operands();
  const RegisterId value = operands.pop_register();
  const RegisterId other = load_operand(work, in);
  combine(work, logic, value, other, false);
  operands.release(other);
  operands.push_register(StackType::Bool, value);
}

void with_operand(FunctionWork& work, Logic logic, StackType type) {
  Operands& operands = work.operands();
  const RegisterId other = operands.pop_register();
  const RegisterId value = operands.pop_register();
  combine(work, logic, value, other, type == StackType::I64);
  operands.release(other);
  operands.push_register(type, value);
}

void invert(FunctionWork& work, StackType type) {
  Operands& operands = work.operands();
  const RegisterId value = operands.pop_register();
  if (type == StackType::Bool) {
    work.out().eor(w(value), w(value), 1);
  } else {
    work.out().mvn(general(value, type), general(value, type));
  }
  operands.push_register(type, value);
}

}  // namespace

bool translate_boolean(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::LoadNotBoolAbs:
    case Opcode::LoadNotBoolThis:
      return load_inverted(work, in), true;
    case Opcode::AndBoolAbs:
    case Opcode::AndBoolThis:
      return with_memory(work, Logic::And, in), true;
    case Opcode::OrBoolAbs:
    case Opcode::OrBoolThis:
      return with_memory(work, Logic::Or, in), true;
    case Opcode::AndNotBoolAbs:
    case Opcode::AndNotBoolThis:
      return with_memory(work, Logic::AndNot, in), true;
    case Opcode::OrNotBoolAbs:
    case Opcode::OrNotBoolThis:
      return with_memory(work, Logic::OrNot, in), true;
    case Opcode::XorBoolAbs:
    case Opcode::XorBoolThis:
      return with_memory(work, Logic::Xor, in), true;
    case Opcode::AndBool:
      return with_operand(work, Logic::And, StackType::Bool), true;
    case Opcode::OrBool:
      return with_operand(work, Logic::Or, StackType::Bool), true;
    case Opcode::XorBool:
      return with_operand(work, Logic::Xor, StackType::Bool), true;
    case Opcode::AndI32:
      return with_operand(work, Logic::And, StackType::I32), true;
    case Opcode::OrI32:
      return with_operand(work, Logic::Or, StackType::I32), true;
    case Opcode::XorI32:
      return with_operand(work, Logic::Xor, StackType::I32), true;
    case Opcode::AndI64:
      return with_operand(work, Logic::And, StackType::I64), true;
    case Opcode::OrI64:
      return with_operand(work, Logic::Or, StackType::I64), true;
    case Opcode::XorI64:
      return with_operand(work, Logic::Xor, StackType::I64), true;
    case Opcode::NotBool:
      return invert(work, StackType::Bool), true;
    case Opcode::NotI32:
      return invert(work, StackType::I32), true;
    case Opcode::NotI64:
      return invert(work, StackType::I64), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
