#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

void push_condition(FunctionWork& work, CondCode condition) {
  if (work.next_is_branch()) return work.leave_in_flags(condition);
  const RegisterId result = work.operands().allocate(false);
  work.out().cset(w(result), condition);
  work.operands().push_register(StackType::Bool, result);
}

void compare_integers(FunctionWork& work, StackType type, CondCode condition) {
  Operands& operands = work.operands();
  Operand y = operands.pop();
  const bool constant = y.is(Operand::Kind::Constant);
  const RegisterId right = constant ? kNoRegister : operands.in_register(y);
  const RegisterId left = operands.pop_register();
  if (constant) {
    work.emit().compare(general(left, type), y.constant);
  } else {
    work.out().cmp(general(left, type), general(right, type));
    operands.release(right);
  }
  operands.release(left);
  push_condition(work, condition);
}

// The conditions are false where one of the two is no number, but for "not equal".
void compare_floats(FunctionWork& work, StackType type, CondCode condition) {
  Operands& operands = work.operands();
  const RegisterId y = operands.pop_register();
  const RegisterId x = operands.pop_register();
  work.out().fcmp(vector(x, type), vector(y, type));
  operands.release(x);
  operands.release(y);
  push_condition(work, condition);
}

void check(FunctionWork& work, StackType type, std::uint64_t lower, std::uint64_t upper, bool is_signed) {
  Operands& operands = work.operands();
  const RegisterId value = operands.pop_register();
  const asmjit::Label outside = work.trap(TrapCode::SubrangeRange);
  work.emit().compare(general(value, type), lower);
  work.emit().branch(is_signed ? CondCode::kLT : CondCode::kLO, outside);
  work.emit().compare(general(value, type), upper);
  work.emit().branch(is_signed ? CondCode::kGT : CondCode::kHI, outside);
  operands.push_register(type, value);
}

std::uint64_t constant(const FunctionWork& work, std::uint32_t index) {
  return work.view().record<Section::Constants>(index);
}

}  // namespace

bool translate_comparison(FunctionWork& work, const Instruction& in) {
  using enum CondCode;
  switch (in.opcode) {
#define STEPWRIGHT_CASES(op, equal_signed, unsigned_, floating)        \
  case Opcode::op##I32:                                                \
    return compare_integers(work, StackType::I32, equal_signed), true; \
  case Opcode::op##I64:                                                \
    return compare_integers(work, StackType::I64, equal_signed), true; \
  case Opcode::op##U32:                                                \
    return compare_integers(work, StackType::I32, unsigned_), true;    \
  case Opcode::op##U64:                                                \
    return compare_integers(work, StackType::I64, unsigned_), true;    \
  case Opcode::op##F32:                                                \
    return compare_floats(work, StackType::F32, floating), true;       \
  case Opcode::op##F64:                                                \
    return compare_floats(work, StackType::F64, floating), true;
    STEPWRIGHT_CASES(Lt, kLT, kLO, kMI)
    STEPWRIGHT_CASES(Le, kLE, kLS, kLS)
    STEPWRIGHT_CASES(Gt, kGT, kHI, kGT)
    STEPWRIGHT_CASES(Ge, kGE, kHS, kGE)
#undef STEPWRIGHT_CASES
    case Opcode::EqI32:
      return compare_integers(work, StackType::I32, kEQ), true;
    case Opcode::EqI64:
    case Opcode::EqRef:
      return compare_integers(work, StackType::I64, kEQ), true;
    case Opcode::EqF32:
      return compare_floats(work, StackType::F32, kEQ), true;
    case Opcode::EqF64:
      return compare_floats(work, StackType::F64, kEQ), true;
    case Opcode::NeI32:
      return compare_integers(work, StackType::I32, kNE), true;
    case Opcode::NeI64:
    case Opcode::NeRef:
      return compare_integers(work, StackType::I64, kNE), true;
    case Opcode::NeF32:
      return compare_floats(work, StackType::F32, kNE), true;
    case Opcode::NeF64:
      return compare_floats(work, StackType::F64, kNE), true;
    case Opcode::CheckI32:
      return check(work, StackType::I32, in.a, in.b, true), true;
    case Opcode::CheckI64:
      return check(work, StackType::I64, constant(work, in.a), constant(work, in.b), true), true;
    case Opcode::CheckU64:
      return check(work, StackType::I64, constant(work, in.a), constant(work, in.b), false), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
