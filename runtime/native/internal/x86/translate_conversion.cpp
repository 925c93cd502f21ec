#include <bit>

#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::IntType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

void to_bool(FunctionWork& work) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const std::uint32_t bytes = width_of(x.type);
  const RegisterId reg = operands.in_register(x);
  work.out().test(general(reg, bytes), general(reg, bytes));
  operands.release(x);
  operands.push_flags(x86::CondCode::kNotZero);
}

void bool_to_integer(FunctionWork& work) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  const RegisterId reg = operands.in_own_register(x);
  work.out().movzx(gp32(reg), gp8(reg));
  operands.push(Value::of_register(StackType::I32, reg));
}

void widen(FunctionWork& work, bool is_signed) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  if (!is_signed) {  // the high half is zero already
    operands.in_register(x);
    x.type = StackType::I64;
    return operands.push(x);
  }
  const RegisterId from = operands.in_register(x);
  operands.release(x);
  const RegisterId result = operands.allocate(false);
  work.out().movsxd(gp64(result), gp32(from));
  operands.push(Value::of_register(StackType::I64, result));
}

void narrow(FunctionWork& work) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  const RegisterId from = operands.in_register(x);
  operands.release(x);
  const RegisterId result = operands.allocate(false);
  work.out().mov(gp32(result), gp32(from));
  operands.push(Value::of_register(StackType::I32, result));
}

void convert(FunctionWork& work, StackType to, RegisterId result, const x86::Gp& from) {
  x86::Assembler& out = work.out();
  to == StackType::F32 ? out.cvtsi2ss(xmm(result), from) : out.cvtsi2sd(xmm(result), from);
}

// Unsigned numbers of 64 bits: half of it, with the lost bit kept for rounding, twice.
void unsigned_to_float(FunctionWork& work, StackType to, RegisterId result, RegisterId from) {
  x86::Assembler& out = work.out();
  Operands& operands = work.operands();
  const asmjit::Label large = out.newLabel();
  const asmjit::Label done = out.newLabel();
  operands.settle_flags();
  const RegisterId half = operands.allocate(false);
  out.test(gp64(from), gp64(from));
  out.js(large);
  convert(work, to, result, gp64(from));
  out.jmp(done);
  out.bind(large);
  out.mov(gp64(kScratch), gp64(from));
  out.mov(gp64(half), gp64(from));
  out.shr(gp64(kScratch), 1);
  out.and_(gp32(half), 1);
  out.or_(gp64(kScratch), gp64(half));
  convert(work, to, result, gp64(kScratch));
  to == StackType::F32 ? out.addss(xmm(result), xmm(result)) : out.addsd(xmm(result), xmm(result));
  out.bind(done);
  operands.registers().release(half);
}

void to_float(FunctionWork& work, StackType to, bool is_signed) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled();
  const RegisterId from = operands.in_register(x);
  RegisterId result = work.destination(to);
  if (result == kNoRegister) result = operands.allocate(true);
  work.out().xorps(xmm(result), xmm(result));  // no dependence on what was there
  if (x.type == StackType::I64 && !is_signed) {
    unsigned_to_float(work, to, result, from);
  } else {
    const bool whole = x.type == StackType::I64 || !is_signed;
    convert(work, to, result, whole ? gp64(from) : gp32(from));
  }
  operands.release(x);
  operands.push(Value::of_register(to, result));
}

void single_to_double(FunctionWork& work) {
  Operands& operands = work.operands();
  Value x = operands.pop_settled_beside_flags();
  const RegisterId from = operands.in_register(x);
  const RegisterId result = operands.allocate(true);
  work.out().cvtss2sd(xmm(result), xmm(from));
  operands.release(x);
  operands.push(Value::of_register(StackType::F64, result));
}

// A finite number that becomes infinite is a trap.
void double_to_single(FunctionWork& work) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const RegisterId from = operands.in_register(x);
  const RegisterId result = operands.allocate(true);
  const asmjit::Label usual = out.newLabel();
  out.cvtsd2ss(xmm(result), xmm(from));
  out.movd(gp32(kScratch), xmm(result));
  out.add(gp32(kScratch), gp32(kScratch));  // without the sign
  out.cmp(gp32(kScratch), static_cast<std::int32_t>(0xFF000000u));
  out.jne(usual);
  out.movq(gp64(kScratch), xmm(from));
  out.rol(gp64(kScratch), 12);  // an infinity: sign and exponent below, zeros above
  out.or_(gp64(kScratch), 0x800);
  out.cmp(gp64(kScratch), 0xFFF);
  out.jne(work.trap(TrapCode::ConversionRange));
  out.bind(usual);
  operands.release(x);
  operands.push(Value::of_register(StackType::F32, result));
}

struct Range {
  double lowest = 0;
  double beyond = 0;
};

constexpr double kTwoTo63 = 9223372036854775808.0;

Range range_of(IntType type) {
  switch (type) {
    case IntType::I8:
      return {-128, 128};
    case IntType::U8:
      return {0, 256};
    case IntType::I16:
      return {-32768, 32768};
    case IntType::U16:
      return {0, 65536};
    case IntType::I32:
      return {-2147483648.0, 2147483648.0};
    case IntType::U32:
      return {0, 4294967296.0};
    case IntType::I64:
      return {-kTwoTo63, kTwoTo63};
    case IntType::U64:
      return {0, 2 * kTwoTo63};
  }
  return {};
}

void large_to_unsigned(FunctionWork& work, RegisterId result, RegisterId number) {
  x86::Assembler& out = work.out();
  Operands& operands = work.operands();
  const asmjit::Label small = out.newLabel();
  const asmjit::Label done = out.newLabel();
  const x86::Mem two_to_63 = operands.constant(std::bit_cast<std::uint64_t>(kTwoTo63), 8);
  out.ucomisd(xmm(number), two_to_63);
  out.jb(small);
  out.subsd(xmm(number), two_to_63);
  out.cvttsd2si(gp64(result), xmm(number));
  out.btc(gp64(result), 63);
  out.jmp(done);
  out.bind(small);
  out.cvttsd2si(gp64(result), xmm(number));
  out.bind(done);
}

// Rounds in double precision, as the interpreter does, then checks the range: NaN is below everything.
void to_integer(FunctionWork& work, IntType type, x86::RoundImm rounding) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value x = operands.pop_settled();
  operands.settle_flags();
  const RegisterId from = operands.in_register(x);
  const RegisterId number = operands.allocate(true);
  const RegisterId result = operands.allocate(false);
  if (x.type == StackType::F32) {
    out.cvtss2sd(xmm(number), xmm(from));
    out.roundsd(xmm(number), xmm(number), rounding);
  } else {
    out.roundsd(xmm(number), xmm(from), rounding);
  }
  const Range range = range_of(type);
  const asmjit::Label outside = work.trap(TrapCode::ConversionRange);
  out.ucomisd(xmm(number), operands.constant(std::bit_cast<std::uint64_t>(range.lowest), 8));
  out.jb(outside);
  out.ucomisd(xmm(number), operands.constant(std::bit_cast<std::uint64_t>(range.beyond), 8));
  out.jae(outside);
  if (type == IntType::U64) {
    large_to_unsigned(work, result, number);
  } else {
    const bool whole = type == IntType::I64 || type == IntType::U32;
    out.cvttsd2si(whole ? gp64(result) : gp32(result), xmm(number));
  }
  operands.registers().release(number);
  operands.release(x);
  operands.push(Value::of_register(stack_type(type), result));
}

}  // namespace

bool translate_conversion(FunctionWork& work, const Instruction& in) {
  constexpr auto kToEven = static_cast<x86::RoundImm>(static_cast<int>(x86::RoundImm::kNearest) |
                                                      static_cast<int>(x86::RoundImm::kSuppress));
  constexpr auto kToZero = static_cast<x86::RoundImm>(static_cast<int>(x86::RoundImm::kTrunc) |
                                                      static_cast<int>(x86::RoundImm::kSuppress));
  switch (in.opcode) {
    case Opcode::BoolToI32:
      return bool_to_integer(work), true;
    case Opcode::I32ToBool:
    case Opcode::I64ToBool:
      return to_bool(work), true;
    case Opcode::I32ToI64:
      return widen(work, true), true;
    case Opcode::U32ToI64:
      return widen(work, false), true;
    case Opcode::I64ToI32:
      return narrow(work), true;
    case Opcode::I32ToF32:
    case Opcode::I64ToF32:
      return to_float(work, StackType::F32, true), true;
    case Opcode::U32ToF32:
    case Opcode::U64ToF32:
      return to_float(work, StackType::F32, false), true;
    case Opcode::I32ToF64:
    case Opcode::I64ToF64:
      return to_float(work, StackType::F64, true), true;
    case Opcode::U32ToF64:
    case Opcode::U64ToF64:
      return to_float(work, StackType::F64, false), true;
    case Opcode::F32ToF64:
      return single_to_double(work), true;
    case Opcode::F64ToF32:
      return double_to_single(work), true;
    case Opcode::RoundF32:
    case Opcode::RoundF64:
      return to_integer(work, static_cast<IntType>(in.a), kToEven), true;
    case Opcode::TruncF32:
    case Opcode::TruncF64:
      return to_integer(work, static_cast<IntType>(in.a), kToZero), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native
