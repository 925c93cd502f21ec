#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;
using bytecode::StackType;

namespace {

void duplicate(FunctionWork& work) {
  Operands& operands = work.operands();
  const StackType type = operands.top_type();
  const RegisterId value = operands.pop_register();
  const RegisterId copy = operands.allocate(is_float(type));
  if (is_float(type)) {
    work.out().fmov(d(copy), d(value));
  } else {
    work.out().mov(x(copy), x(value));
  }
  operands.push_register(type, value);
  operands.push_register(type, copy);
}

void drop(FunctionWork& work) {
  const Operand value = work.operands().pop();
  if (value.is(Operand::Kind::Register)) work.operands().release(value.reg);
}

// The operand below the BOOL where it is TRUE, else the one below that.
void select(FunctionWork& work) {
  Operands& operands = work.operands();
  const RegisterId condition = operands.pop_register();
  const StackType type = operands.top_type();
  const RegisterId if_true = operands.pop_register();
  const RegisterId if_false = operands.pop_register();
  work.out().cmp(w(condition), 0);
  if (is_float(type)) {
    work.out().fcsel(d(if_false), d(if_true), d(if_false), CondCode::kNE);
  } else {
    work.out().csel(x(if_false), x(if_true), x(if_false), CondCode::kNE);
  }
  operands.release(condition);
  operands.release(if_true);
  operands.push_register(type, if_false);
}

void push_time(FunctionWork& work) {
  const RegisterId to = work.operands().allocate(false);
  work.out().ldr(x(to), work.field(offsetof(Context, now_ns)));
  work.operands().push_register(StackType::I64, to);
}

}  // namespace

bool translate_stack(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  switch (in.opcode) {
    case Opcode::ConstBool:
      return operands.push_constant(StackType::Bool, in.a), true;
    case Opcode::ConstI32:
      return operands.push_constant(StackType::I32, in.a), true;
    case Opcode::ConstF32:
      return operands.push_constant(StackType::F32, in.a), true;
    case Opcode::ConstI64:
      return operands.push_constant(StackType::I64, work.view().record<Section::Constants>(in.a)), true;
    case Opcode::ConstF64:
      return operands.push_constant(StackType::F64, work.view().record<Section::Constants>(in.a)), true;
    case Opcode::ConstNull:
      return operands.push_constant(StackType::Ref, bytecode::kNullRef), true;
    case Opcode::Dup:
      return duplicate(work), true;
    case Opcode::Drop:
      return drop(work), true;
    case Opcode::Select:
      return select(work), true;
    case Opcode::Now:
      return push_time(work), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
