// Conversions between elementary types (IEC 61131-3, 6.6.2.5.3). Reals round to the nearest, ties to even,
// and trap outside of the target; integers wrap; TIME and TOD count as milliseconds, DATE and DT as seconds.

#include "ladder/codegen/expression_emitter.h"
#include "ladder/codegen/machine_type.h"
#include "ladder/semantics/constants/constant_conversion.h"

namespace stepwright::codegen {

using bytecode::Opcode;
using semantics::Type;

namespace {

bool counts_ns(const Type& type) {
  using enum semantics::ElementaryType;
  return type.is_time() || type.is(Date) || type.is(Tod) || type.is(Dt);
}

}  // namespace

void ExpressionEmitter::convert(const Type& from, const Type& to) {
  if (counts_ns(from) || counts_ns(to)) return time_conversion(from, to);
  if (to.is_bool()) {
    if (from.is_bool()) return;
    if (from.is_real()) {
      constant({}, from);
      return b_.emit(from.size == 4 ? Opcode::NeF32 : Opcode::NeF64);
    }
    if (from.is_bits()) {
      // The rightmost bit (table 25).
      if (from.size == 8) b_.emit(Opcode::I64ToI32);
      b_.const_i32(1);
      b_.emit(Opcode::AndI32);
      return b_.emit(Opcode::I32ToBool);
    }
    return b_.emit(from.size == 8 ? Opcode::I64ToBool : Opcode::I32ToBool);
  }
  if (semantics::transfers_bits(from, to)) return transfer_bits(from, to);
  if (semantics::is_narrowed_character(from, to)) return narrow_character();
  if (to.is_real()) return to_real(from, to);
  to_integer(from, to);
}

// The same bytes, read as the other type (table 26).
void ExpressionEmitter::transfer_bits(const Type& from, const Type& to) {
  const std::uint32_t at = temporary(from.size);
  const writer::LocalId value = local(semantics::slot_type(from));
  b_.local_set(value);
  b_.addr_frame(at);
  b_.local_get(value);
  b_.store(semantics::mem_type(from), bytecode::AddressMode::Ind);
  b_.addr_frame(at);
  b_.load(semantics::mem_type(to), bytecode::AddressMode::Ind);
}

void ExpressionEmitter::narrow_character() {
  const writer::LocalId character = local(bytecode::StackType::I32);
  b_.local_set(character);
  b_.local_get(character);
  b_.const_i32(semantics::kNoCharacter);
  b_.local_get(character);
  b_.const_i32(0xFF);
  b_.emit(Opcode::GtI32);
  b_.emit(Opcode::Select);
}

void ExpressionEmitter::to_real(const Type& from, const Type& to) {
  const bool single = to.size == 4;
  switch (machine_type(from)) {
    case Machine::Bool:
      b_.emit(Opcode::BoolToI32);
      return b_.emit(single ? Opcode::I32ToF32 : Opcode::I32ToF64);
    case Machine::I32:
      return b_.emit(single ? Opcode::I32ToF32 : Opcode::I32ToF64);
    case Machine::U32:
      return b_.emit(single ? Opcode::U32ToF32 : Opcode::U32ToF64);
    case Machine::I64:
      return b_.emit(single ? Opcode::I64ToF32 : Opcode::I64ToF64);
    case Machine::U64:
      return b_.emit(single ? Opcode::U64ToF32 : Opcode::U64ToF64);
    case Machine::F32:
      if (!single) b_.emit(Opcode::F32ToF64);
      return;
    case Machine::F64:
      if (single) b_.emit(Opcode::F64ToF32);
      return;
    case Machine::Ref:
      return;
  }
}

void ExpressionEmitter::to_integer(const Type& from, const Type& to) {
  const bool wide = to.size == 8;
  switch (machine_type(from)) {
    case Machine::F32:
      return b_.to_int(Opcode::RoundF32, int_type(to));
    case Machine::F64:
      return b_.to_int(Opcode::RoundF64, int_type(to));
    case Machine::Bool:
      b_.emit(Opcode::BoolToI32);
      if (wide) b_.emit(Opcode::U32ToI64);
      return;
    case Machine::I32:
      if (wide) return b_.emit(Opcode::I32ToI64);
      break;
    case Machine::U32:
      if (wide) return b_.emit(Opcode::U32ToI64);
      break;
    case Machine::I64:
    case Machine::U64:
      if (wide) return;
      b_.emit(Opcode::I64ToI32);
      break;
    case Machine::Ref:
      return;
  }
  // Cut off what the target cannot hold; a conversion that widens changes nothing.
  if (!semantics::widens(from, to)) wrap(to);
}

// Between times, dates and numbers.
void ExpressionEmitter::time_conversion(const Type& from, const Type& to) {
  using enum semantics::ElementaryType;
  if (&from == &to) return;
  if (counts_ns(from) && counts_ns(to)) {
    if (to.is(Dt)) return;
    if (to.is(Tod)) return time_of_day();
    b_.emit(Opcode::Dup);
    time_of_day();
    return b_.emit(Opcode::SubI64);
  }
  const std::int64_t unit = semantics::time_unit_ns(counts_ns(from) ? from : to);
  if (counts_ns(from)) {
    if (!to.is_real()) {
      b_.const_i64(unit);
      b_.emit(Opcode::DivI64);
      if (to.size == 8) return;
      b_.emit(Opcode::I64ToI32);
      return wrap(to);
    }
    b_.emit(Opcode::I64ToF64);
    b_.const_f64(static_cast<double>(unit));
    b_.emit(Opcode::DivF64);
    if (to.size == 4) b_.emit(Opcode::F64ToF32);
    return;
  }
  if (from.is_real()) {
    if (from.size == 4) b_.emit(Opcode::F32ToF64);
    b_.const_f64(static_cast<double>(unit));
    b_.emit(Opcode::MulF64);
    return b_.to_int(Opcode::RoundF64, bytecode::IntType::I64);
  }
  widen(from);
  b_.const_i64(unit);
  b_.emit(Opcode::MulI64);
}

}  // namespace stepwright::codegen
