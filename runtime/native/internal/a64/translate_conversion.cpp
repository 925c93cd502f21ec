#include <bit>

#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::Instruction;
using bytecode::IntType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

void to_bool(FunctionWork& work, StackType from) {
  const RegisterId value = work.operands().pop_register();
  work.out().cmp(general(value, from), 0);
  work.out().cset(w(value), CondCode::kNE);
  work.operands().push_register(StackType::Bool, value);
}

// The same bits as another type: FALSE and TRUE are 0 and 1, the high half of an I32 is zero.
void retype(FunctionWork& work, StackType to) {
  const RegisterId value = work.operands().pop_register();
  work.operands().push_register(to, value);
}

void widen(FunctionWork& work) {
  const RegisterId value = work.operands().pop_register();
  work.out().sxtw(x(value), w(value));
  work.operands().push_register(StackType::I64, value);
}

void narrow(FunctionWork& work) {
  const RegisterId value = work.operands().pop_register();
  work.out().mov(w(value), w(value));
  work.operands().push_register(StackType::I32, value);
}

void to_float(FunctionWork& work, StackType from, StackType to, bool is_signed) {
  Operands& operands = work.operands();
  const RegisterId value = operands.pop_register();
  const RegisterId result = operands.allocate(true);
  if (is_signed) {
    work.out().scvtf(vector(result, to), general(value, from));
  } else {
    work.out().ucvtf(vector(result, to), general(value, from));
  }
  operands.release(value);
  operands.push_register(to, result);
}

void single_to_double(FunctionWork& work) {
  const RegisterId value = work.operands().pop_register();
  work.out().fcvt(d(value), s(value));
  work.operands().push_register(StackType::F64, value);
}

// A finite number that becomes infinite is a trap.
void double_to_single(FunctionWork& work) {
  Operands& operands = work.operands();
  Assembler& out = work.out();
  const RegisterId value = operands.pop_register();
  const RegisterId result = operands.allocate(true);
  const asmjit::Label usual = out.newLabel();
  out.fcvt(s(result), d(value));
  out.fmov(w(kScratch), s(result));
  out.lsl(w(kScratch), w(kScratch), 1);  // without the sign
  work.emit().constant(w(kAddress), 0xFF000000u);
  out.cmp(w(kScratch), w(kAddress));
  out.b(CondCode::kNE, usual);
  out.fmov(x(kScratch), d(value));
  out.lsl(x(kScratch), x(kScratch), 1);
  work.emit().constant(x(kAddress), std::uint64_t{0xFFE} << 52);
  out.cmp(x(kScratch), x(kAddress));
  work.emit().branch(CondCode::kNE, work.trap(TrapCode::ConversionRange));
  out.bind(usual);
  operands.release(value);
  operands.push_register(StackType::F32, result);
}

struct Range {
  double lowest = 0;
  double beyond = 0;
};

constexpr Range range_of(IntType type) {
  constexpr double kTwoTo63 = 9223372036854775808.0;
  constexpr Range kRanges[bytecode::kIntTypeCount] = {{-128, 128},
                                                      {0, 256},
                                                      {-32768, 32768},
                                                      {0, 65536},
                                                      {-2147483648.0, 2147483648.0},
                                                      {0, 4294967296.0},
                                                      {-kTwoTo63, kTwoTo63},
                                                      {0, 2 * kTwoTo63}};
  return kRanges[static_cast<std::uint8_t>(type)];
}

// Compares a register with a number, which goes through another one.
void compare_with(FunctionWork& work, RegisterId number, RegisterId other, double bound) {
  work.emit().constant(x(kScratch), std::bit_cast<std::uint64_t>(bound));
  work.out().fmov(d(other), x(kScratch));
  work.out().fcmp(d(number), d(other));
}

// Rounds in double precision, as the interpreter does, then checks the range; "less" holds for a NaN as well.
void to_integer(FunctionWork& work, StackType from, IntType type, bool truncate) {
  Operands& operands = work.operands();
  Assembler& out = work.out();
  const RegisterId number = operands.pop_register();
  const RegisterId bound = operands.allocate(true);
  const RegisterId result = operands.allocate(false);
  if (from == StackType::F32) out.fcvt(d(number), s(number));
  truncate ? out.frintz(d(number), d(number)) : out.frintn(d(number), d(number));
  const Range range = range_of(type);
  const asmjit::Label outside = work.trap(TrapCode::ConversionRange);
  compare_with(work, number, bound, range.lowest);
  work.emit().branch(CondCode::kLT, outside);
  compare_with(work, number, bound, range.beyond);
  work.emit().branch(CondCode::kGE, outside);
  if (type == IntType::U64) {
    out.fcvtzu(x(result), d(number));
  } else {
    out.fcvtzs(x(result), d(number));
    if (type != IntType::I64) out.mov(w(result), w(result));
  }
  operands.release(number);
  operands.release(bound);
  operands.push_register(stack_type(type), result);
}

}  // namespace

bool translate_conversion(FunctionWork& work, const Instruction& in) {
  using enum StackType;
  switch (in.opcode) {
    case Opcode::BoolToI32:
      return retype(work, I32), true;
    case Opcode::I32ToBool:
      return to_bool(work, I32), true;
    case Opcode::I64ToBool:
      return to_bool(work, I64), true;
    case Opcode::I32ToI64:
      return widen(work), true;
    case Opcode::U32ToI64:
      return retype(work, I64), true;
    case Opcode::I64ToI32:
      return narrow(work), true;
    case Opcode::I32ToF32:
      return to_float(work, I32, F32, true), true;
    case Opcode::U32ToF32:
      return to_float(work, I32, F32, false), true;
    case Opcode::I64ToF32:
      return to_float(work, I64, F32, true), true;
    case Opcode::U64ToF32:
      return to_float(work, I64, F32, false), true;
    case Opcode::I32ToF64:
      return to_float(work, I32, F64, true), true;
    case Opcode::U32ToF64:
      return to_float(work, I32, F64, false), true;
    case Opcode::I64ToF64:
      return to_float(work, I64, F64, true), true;
    case Opcode::U64ToF64:
      return to_float(work, I64, F64, false), true;
    case Opcode::F32ToF64:
      return single_to_double(work), true;
    case Opcode::F64ToF32:
      return double_to_single(work), true;
    case Opcode::RoundF32:
      return to_integer(work, F32, static_cast<IntType>(in.a), false), true;
    case Opcode::RoundF64:
      return to_integer(work, F64, static_cast<IntType>(in.a), false), true;
    case Opcode::TruncF32:
      return to_integer(work, F32, static_cast<IntType>(in.a), true), true;
    case Opcode::TruncF64:
      return to_integer(work, F64, static_cast<IntType>(in.a), true), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64
