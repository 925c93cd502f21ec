// Standard functions that are more than one instruction (IEC 61131-3, 6.6.2.5).

#include <limits>

#include "ladder/codegen/expression_emitter.h"
#include "ladder/codegen/machine_type.h"
#include "runtime/bytecode/trap.h"

namespace stepwright::codegen {

using bytecode::IntrinsicId;
using bytecode::Opcode;
using semantics::StandardFunction;
using semantics::Type;
using semantics::Value;
using syntax::Operator;

namespace {

constexpr std::int64_t kDayNs = 86'400'000'000'000;

// Of Sqrt to Power.
IntrinsicId real_intrinsic(StandardFunction function, bool single) {
  struct Row {
    StandardFunction function;
    IntrinsicId single;
    IntrinsicId twice;
  };
#define STEPWRIGHT_ROW(name) \
  { StandardFunction::name, IntrinsicId::name##F32, IntrinsicId::name##F64 }
  static constexpr Row kRows[] = {
      STEPWRIGHT_ROW(Sqrt), STEPWRIGHT_ROW(Sin),
      STEPWRIGHT_ROW(Cos),  STEPWRIGHT_ROW(Tan),
      STEPWRIGHT_ROW(Asin), STEPWRIGHT_ROW(Acos),
      STEPWRIGHT_ROW(Atan), STEPWRIGHT_ROW(Atan2),
      STEPWRIGHT_ROW(Exp),  STEPWRIGHT_ROW(Ln),
      STEPWRIGHT_ROW(Log),  {StandardFunction::Power, IntrinsicId::PowF32, IntrinsicId::PowF64}};
#undef STEPWRIGHT_ROW
  for (const Row& row : kRows)
    if (row.function == function) return single ? row.single : row.twice;
  return IntrinsicId::SqrtF64;
}

}  // namespace

void ExpressionEmitter::standard(const Value& value) {
  const Type& from = *value.operands[0]->type;
  const bool single = from.is_real() && from.size == 4;
  if (value.function == StandardFunction::Min || value.function == StandardFunction::Max)
    return extremum(value);
  for (const auto& each : value.operands) this->value(*each);
  switch (value.function) {
    case StandardFunction::Abs:
      if (from.is_unsigned()) return;
      b_.intrinsic(abs_intrinsic(machine_type(from)));
      return wrap(from);
    case StandardFunction::SwapBytes:
      return swap_bytes(from);
    case StandardFunction::FromBcd:
      return from_bcd(from, *value.type);
    case StandardFunction::ToBcd:
      return to_bcd(from, *value.type);
    case StandardFunction::IsValidBcd:
      widen(from);
      return is_valid_bcd();
    case StandardFunction::TimeOfDay:
      return time_of_day();
    case StandardFunction::IsValid:
      // NaN compares as FALSE with everything.
      b_.intrinsic(single ? IntrinsicId::AbsF32 : IntrinsicId::AbsF64);
      if (single) {
        b_.const_f32(std::numeric_limits<float>::max());
      } else {
        b_.const_f64(std::numeric_limits<double>::max());
      }
      return b_.emit(single ? Opcode::LeF32 : Opcode::LeF64);
    default:
      return b_.intrinsic(real_intrinsic(value.function, single));
  }
}

void ExpressionEmitter::extremum(const Value& value) {
  const bool maximum = value.function == StandardFunction::Max;
  if (value.type->is_string()) return extreme_text(value, maximum);
  const Machine machine = machine_type(*value.type);
  this->value(*value.operands[0]);
  for (std::size_t i = 1; i < value.operands.size(); ++i) {
    this->value(*value.operands[i]);
    if (machine == Machine::Bool) {
      b_.emit(maximum ? Opcode::OrBool : Opcode::AndBool);
    } else {
      b_.intrinsic(extremum_intrinsic(maximum, machine));
    }
  }
}

void ExpressionEmitter::chain(const Value& value) {
  const Type& type = *value.operands[0]->type;
  std::vector<writer::LocalId> locals;
  for (const auto& each : value.operands) {
    locals.push_back(local(type.is_string() ? bytecode::StackType::Ref : semantics::slot_type(*each->type)));
    this->value(*each);
    b_.local_set(locals.back());
  }
  const bool as_number = type.is_bool() && value.op != Operator::Equal;
  for (std::size_t i = 0; i + 1 < locals.size(); ++i) {
    for (const std::size_t side : {i, i + 1}) {
      b_.local_get(locals[side]);
      if (as_number) b_.emit(Opcode::BoolToI32);
    }
    if (type.is_string()) {
      compare_texts(value.op, type);
    } else if (as_number) {
      b_.emit(binary_opcode(value.op, Machine::U32));
    } else {
      operation(value.op, type);
    }
    if (i > 0) b_.emit(Opcode::AndBool);
  }
}

// Swaps neighbouring groups of bits: x -> (x >> bits & mask) | (x & mask) << bits.
void ExpressionEmitter::swap_groups(unsigned bits, bool wide) {
  const std::uint64_t mask = bits == 8 ? 0x00FF00FF00FF00FFu : 0x0000FFFF0000FFFFu;
  const auto push_mask = [&] {
    if (wide) return b_.const_i64(static_cast<std::int64_t>(mask));
    b_.const_i32(static_cast<std::int32_t>(mask & 0xFFFFFFFFu));
  };
  b_.emit(Opcode::Dup);
  push_mask();
  b_.emit(wide ? Opcode::AndI64 : Opcode::AndI32);
  b_.const_i32(static_cast<std::int32_t>(bits));
  b_.emit(wide ? Opcode::ShlI64 : Opcode::ShlI32);
  const writer::LocalId upper = local(wide ? bytecode::StackType::I64 : bytecode::StackType::I32);
  b_.local_set(upper);
  b_.const_i32(static_cast<std::int32_t>(bits));
  b_.emit(wide ? Opcode::ShrI64 : Opcode::ShrI32);
  push_mask();
  b_.emit(wide ? Opcode::AndI64 : Opcode::AndI32);
  b_.local_get(upper);
  b_.emit(wide ? Opcode::OrI64 : Opcode::OrI32);
}

void ExpressionEmitter::swap_bytes(const Type& type) {
  const bool wide = type.size == 8;
  if (type.size == 2) {
    // The upper bits of a narrow signed number are its sign.
    b_.emit(Opcode::WrapU16);
    b_.const_i32(8);
    b_.rotate_i32(Opcode::RolI32, 16);
    return wrap(type);
  }
  swap_groups(8, wide);
  if (wide) swap_groups(16, wide);
  b_.const_i32(wide ? 32 : 16);
  if (wide) return b_.emit(Opcode::RolI64);
  b_.rotate_i32(Opcode::RolI32, 32);
}

// An integer or bit string as 64 bits.
void ExpressionEmitter::widen(const Type& type) {
  if (type.size != 8) b_.emit(type.is_unsigned() ? Opcode::U32ToI64 : Opcode::I32ToI64);
}

// Takes a BOOL.
void ExpressionEmitter::trap_unless(bytecode::TrapCode code) {
  const writer::Label good = b_.new_label();
  b_.jump_if_true(good);
  b_.trap(static_cast<std::uint8_t>(code));
  b_.bind(good);
}

// Takes 64 bits. A digit is none if its bit 8 and one of its bits 4 and 2 are set.
void ExpressionEmitter::is_valid_bcd() {
  const writer::LocalId code = local(bytecode::StackType::I64);
  b_.local_set(code);
  const auto shifted = [&](std::int32_t bits) {
    b_.local_get(code);
    b_.const_i32(bits);
    b_.emit(Opcode::ShrI64);
  };
  shifted(1);
  shifted(2);
  b_.emit(Opcode::OrI64);
  shifted(3);
  b_.emit(Opcode::AndI64);
  b_.const_i64(0x1111111111111111);
  b_.emit(Opcode::AndI64);
  b_.const_i64(0);
  b_.emit(Opcode::EqI64);
}

// From the highest digit down: number := number * 10 + digit.
void ExpressionEmitter::from_bcd(const Type& from, const Type& to) {
  const writer::LocalId rest = local(bytecode::StackType::I64);
  const writer::LocalId number = local(bytecode::StackType::I64);
  const unsigned bits = from.bit_count();
  widen(from);
  b_.local_set(rest);
  b_.local_get(rest);
  is_valid_bcd();
  trap_unless(bytecode::TrapCode::ConversionRange);
  b_.const_i64(0);
  b_.local_set(number);
  for (unsigned shift = bits; shift > 0; shift -= 4) {
    b_.local_get(number);
    b_.const_i64(10);
    b_.emit(Opcode::MulI64);
    b_.local_get(rest);
    b_.const_i32(static_cast<std::int32_t>(shift - 4));
    b_.emit(Opcode::ShrI64);
    b_.const_i64(15);
    b_.emit(Opcode::AndI64);
    b_.emit(Opcode::AddI64);
    b_.local_set(number);
  }
  b_.local_get(number);
  b_.const_i64(static_cast<std::int64_t>(semantics::range_of(to.elementary).high));
  b_.emit(Opcode::LeU64);
  trap_unless(bytecode::TrapCode::ConversionRange);
  b_.local_get(number);
  if (to.size != 8) b_.emit(Opcode::I64ToI32);
}

// From the lowest digit up; a number with more digits than the target has is out of range.
void ExpressionEmitter::to_bcd(const Type& from, const Type& to) {
  const writer::LocalId rest = local(bytecode::StackType::I64);
  const writer::LocalId code = local(bytecode::StackType::I64);
  widen(from);
  b_.local_set(rest);
  b_.const_i64(0);
  b_.local_set(code);
  for (unsigned shift = 0; shift < to.bit_count(); shift += 4) {
    b_.local_get(code);
    b_.local_get(rest);
    b_.const_i64(10);
    b_.emit(Opcode::ModU64);
    b_.const_i32(static_cast<std::int32_t>(shift));
    b_.emit(Opcode::ShlI64);
    b_.emit(Opcode::OrI64);
    b_.local_set(code);
    b_.local_get(rest);
    b_.const_i64(10);
    b_.emit(Opcode::DivU64);
    b_.local_set(rest);
  }
  b_.local_get(rest);
  b_.const_i64(0);
  b_.emit(Opcode::EqI64);
  trap_unless(bytecode::TrapCode::ConversionRange);
  b_.local_get(code);
  if (to.size != 8) b_.emit(Opcode::I64ToI32);
}

// Nanoseconds since midnight, also of a negative number.
void ExpressionEmitter::time_of_day() {
  b_.const_i64(kDayNs);
  b_.emit(Opcode::ModI64);
  b_.const_i64(kDayNs);
  b_.emit(Opcode::AddI64);
  b_.const_i64(kDayNs);
  b_.emit(Opcode::ModI64);
}

}  // namespace stepwright::codegen
