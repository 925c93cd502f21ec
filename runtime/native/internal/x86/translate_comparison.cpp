#include <utility>

#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;
using bytecode::StackType;
using bytecode::TrapCode;
using x86_Cond = asmjit::x86::CondCode;
namespace x86 = asmjit::x86;

namespace {

void compare(FunctionWork& work, StackType type, x86_Cond condition) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  operands.settle_flags();
  if (x.is(Value::Kind::Constant) && !y.is(Value::Kind::Constant)) {
    std::swap(x, y);
    condition = x86::reverseCond(condition);
  }
  const std::uint32_t bytes = width_of(type);
  // An immediate can be compared with memory; anything else with a register.
  const asmjit::Operand right = operands.source(y, bytes);
  asmjit::Operand left = x.is(Value::Kind::Constant) || !right.isImm()
                             ? asmjit::Operand(general(operands.in_register(x), bytes))
                             : operands.source(x, bytes);
  work.out().emit(x86::Inst::kIdCmp, left, right);
  operands.release(x);
  operands.release(y);
  operands.push_flags(condition);
}

// The value stays on the stack if it lies within the bounds.
void check_range(FunctionWork& work, StackType type, bool is_signed, std::uint64_t lower,
                 std::uint64_t upper) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const std::uint32_t bytes = width_of(type);
  const x86::Gp reg = general(operands.in_register(x), bytes);
  const auto compare_with = [&](std::uint64_t bound) {
    const auto wide = static_cast<std::int64_t>(bound);
    if (bytes == 4 || wide == static_cast<std::int32_t>(wide)) {
      out.cmp(reg, static_cast<std::int32_t>(bound));
    } else {
      out.mov(gp64(kScratch), bound);
      out.cmp(reg, gp64(kScratch));
    }
  };
  const asmjit::Label outside = work.trap(TrapCode::SubrangeRange);
  compare_with(lower);
  is_signed ? out.jl(outside) : out.jb(outside);
  compare_with(upper);
  is_signed ? out.jg(outside) : out.ja(outside);
  operands.push(x);
}

x86::Inst::Id ordered_compare(StackType type) {
  return type == StackType::F32 ? x86::Inst::kIdUcomiss : x86::Inst::kIdUcomisd;
}

void emit_compare(FunctionWork& work, StackType type, Value& x, Value& y) {
  Operands& operands = work.operands();
  const asmjit::Operand left = xmm(operands.in_register(x));
  work.out().emit(ordered_compare(type), left, operands.float_source(y));
  operands.release(x);
  operands.release(y);
}

// True if x > y or x >= y; FALSE for a NaN, as "above" is not set then.
void compare_float(FunctionWork& work, StackType type, x86_Cond condition, bool swap) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  operands.settle_flags();
  if (swap) std::swap(x, y);
  emit_compare(work, type, x, y);
  operands.push_flags(condition);
}

// Equality needs two flags: equal, and not unordered.
void equal_float(FunctionWork& work, StackType type, bool equal) {
  Operands& operands = work.operands();
  Value y = operands.pop_settled();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const RegisterId result = operands.allocate(false);
  emit_compare(work, type, x, y);
  if (equal) {
    work.out().setnp(gp8(result));
    work.out().sete(gp8(kScratch));
    work.out().and_(gp8(result), gp8(kScratch));
  } else {
    work.out().setp(gp8(result));
    work.out().setne(gp8(kScratch));
    work.out().or_(gp8(result), gp8(kScratch));
  }
  operands.push(Value::of_register(StackType::Bool, result));
}

// The condition of an integer comparison; Z for none.
struct IntegerComparison {
  StackType type = StackType::Bool;
  x86_Cond condition = x86_Cond::kZero;
};

IntegerComparison integer_comparison(Opcode opcode) {
  switch (opcode) {
#define STEPWRIGHT_COMPARISON(op, signed_condition)      \
  case Opcode::op##I32:                                  \
    return {StackType::I32, x86_Cond::signed_condition}; \
  case Opcode::op##I64:                                  \
    return {StackType::I64, x86_Cond::signed_condition};
#define STEPWRIGHT_UNSIGNED_COMPARISON(op, unsigned_condition) \
  case Opcode::op##U32:                                        \
    return {StackType::I32, x86_Cond::unsigned_condition};     \
  case Opcode::op##U64:                                        \
    return {StackType::I64, x86_Cond::unsigned_condition};
    STEPWRIGHT_COMPARISON(Eq, kEqual)
    STEPWRIGHT_COMPARISON(Ne, kNotEqual)
    STEPWRIGHT_COMPARISON(Lt, kSignedLT)
    STEPWRIGHT_COMPARISON(Le, kSignedLE)
    STEPWRIGHT_COMPARISON(Gt, kSignedGT)
    STEPWRIGHT_COMPARISON(Ge, kSignedGE)
    STEPWRIGHT_UNSIGNED_COMPARISON(Lt, kUnsignedLT)
    STEPWRIGHT_UNSIGNED_COMPARISON(Le, kUnsignedLE)
    STEPWRIGHT_UNSIGNED_COMPARISON(Gt, kUnsignedGT)
    STEPWRIGHT_UNSIGNED_COMPARISON(Ge, kUnsignedGE)
#undef STEPWRIGHT_COMPARISON
#undef STEPWRIGHT_UNSIGNED_COMPARISON
    default:
      return {};
  }
}

}  // namespace

bool translate_comparison(FunctionWork& work, const Instruction& in) {
  const IntegerComparison integer = integer_comparison(in.opcode);
  if (integer.type != StackType::Bool) return compare(work, integer.type, integer.condition), true;
  constexpr auto kAbove = x86_Cond::kUnsignedGT;
  constexpr auto kAboveOrEqual = x86_Cond::kUnsignedGE;
  const auto constant = [&](std::uint32_t index) { return work.view().record<Section::Constants>(index); };
  switch (in.opcode) {
    case Opcode::EqRef:
      return compare(work, StackType::Ref, x86_Cond::kEqual), true;
    case Opcode::NeRef:
      return compare(work, StackType::Ref, x86_Cond::kNotEqual), true;
    case Opcode::CheckI32:
      return check_range(work, StackType::I32, true, in.a, in.b), true;
    case Opcode::CheckI64:
      return check_range(work, StackType::I64, true, constant(in.a), constant(in.b)), true;
    case Opcode::CheckU64:
      return check_range(work, StackType::I64, false, constant(in.a), constant(in.b)), true;
    case Opcode::EqF32:
      return equal_float(work, StackType::F32, true), true;
    case Opcode::EqF64:
      return equal_float(work, StackType::F64, true), true;
    case Opcode::NeF32:
      return equal_float(work, StackType::F32, false), true;
    case Opcode::NeF64:
      return equal_float(work, StackType::F64, false), true;
    case Opcode::LtF32:
      return compare_float(work, StackType::F32, kAbove, true), true;
    case Opcode::LtF64:
      return compare_float(work, StackType::F64, kAbove, true), true;
    case Opcode::LeF32:
      return compare_float(work, StackType::F32, kAboveOrEqual, true), true;
    case Opcode::LeF64:
      return compare_float(work, StackType::F64, kAboveOrEqual, true), true;
    case Opcode::GtF32:
      return compare_float(work, StackType::F32, kAbove, false), true;
    case Opcode::GtF64:
      return compare_float(work, StackType::F64, kAbove, false), true;
    case Opcode::GeF32:
      return compare_float(work, StackType::F32, kAboveOrEqual, false), true;
    case Opcode::GeF64:
      return compare_float(work, StackType::F64, kAboveOrEqual, false), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
