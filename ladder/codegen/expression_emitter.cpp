#include "ladder/codegen/expression_emitter.h"

#include "ladder/codegen/machine_type.h"
#include "runtime/bytecode/trap.h"

namespace stepwright::codegen {

using bytecode::AddressMode;
using bytecode::Opcode;
using semantics::Base;
using semantics::Place;
using semantics::Type;
using semantics::Value;
using semantics::ValueKind;
using syntax::Operator;

void ExpressionEmitter::value(const Value& value, Width width) {
  switch (value.kind) {
    case ValueKind::Constant:
      return constant(value.constant, *value.type);
    case ValueKind::Load:
      return load(value.place);
    case ValueKind::Reference:
      return reference(value.place);
    case ValueKind::Unary:
      return unary(value, width);
    case ValueKind::Binary:
      return binary(value, width);
    case ValueKind::Convert:
      this->value(*value.operands[0]);
      return convert(*value.operands[0]->type, *value.type);
    case ValueKind::Truncate:
      this->value(*value.operands[0]);
      return b_.to_int(
          machine_type(*value.operands[0]->type) == Machine::F32 ? Opcode::TruncF32 : Opcode::TruncF64,
          int_type(*value.type));
    case ValueKind::Standard:
      return standard(value);
    case ValueKind::Shift:
      return shift(value);
    case ValueKind::Select:
      return select(value);
    case ValueKind::Multiplex:
      return multiplex(value);
    case ValueKind::Call:
      copies_before(value.before);
      for (const auto& each : value.operands) this->value(*each);
      b_.call(layout_.functions.at(value.pou));
      return copies_after(value.after);
    case ValueKind::Chain:
      return chain(value);
    case ValueKind::Fail:
      return b_.trap(static_cast<std::uint8_t>(bytecode::TrapCode::BadArgument));
    case ValueKind::Now:
      return b_.emit(Opcode::Now);
  }
}

void ExpressionEmitter::constant(const semantics::Constant& constant, const Type& type) {
  switch (machine_type(type)) {
    case Machine::Bool:
      return b_.const_bool(constant.integer != 0);
    case Machine::I32:
    case Machine::U32:
      return b_.const_i32(static_cast<std::int32_t>(constant.integer));
    case Machine::I64:
    case Machine::U64:
      return b_.const_i64(static_cast<std::int64_t>(constant.integer));
    case Machine::F32:
      return b_.const_f32(static_cast<float>(constant.real));
    case Machine::F64:
      return b_.const_f64(constant.real);
  }
}

void ExpressionEmitter::load(const Place& place) {
  if (place.base == Base::Slot) return b_.local_get(writer::LocalId(place.slot));
  if (place.bit != bytecode::kNoBit) return b_.load_bit(address(place), place.bit);
  const bytecode::MemType type = bytecode::mem_type(place.type->elementary);
  if (!place.is_direct()) {
    reference(place);
    return b_.load(type, AddressMode::Ind);
  }
  if (in_area(place)) return b_.load(type, AddressMode::Abs, address(place));
  b_.load(type, AddressMode::This, place.offset);
}

void ExpressionEmitter::reference(const Place& place) {
  switch (place.base) {
    case Base::This:
      b_.addr_this(place.offset);
      break;
    case Base::ThisRef:
      b_.load(bytecode::MemType::Ref, AddressMode::This, place.offset);
      break;
    case Base::Slot:
    case Base::SlotRef:
      b_.local_get(writer::LocalId(place.slot));
      break;
    default:
      b_.addr_abs(address(place));
  }
  for (const semantics::PlaceStep& step : place.steps) {
    if (step.index) {
      value(*step.index);
      b_.index(step.lower, step.upper, step.stride);
    }
    if (step.offset != 0) b_.offset(step.offset);
  }
}

void ExpressionEmitter::assign(const Place& place, const Value& value) {
  if (value.kind == ValueKind::Reference) {
    // A VAR_IN_OUT of an instance, or a slot that keeps an address.
    if (place.base == Base::Slot) {
      this->value(value);
      return b_.local_set(writer::LocalId(place.slot));
    }
    if (place.is_direct()) {
      this->value(value);
      if (in_area(place)) return b_.store(bytecode::MemType::Ref, AddressMode::Abs, address(place));
      return b_.store(bytecode::MemType::Ref, AddressMode::This, place.offset);
    }
    reference(place);
    this->value(value);
    return b_.store(bytecode::MemType::Ref, AddressMode::Ind);
  }
  if (!place.type->is_scalar()) {
    reference(place);
    reference(value.place);
    return b_.mem_copy(place.type->size);
  }
  store(place, [&](Width width) { this->value(value, width); });
}

void ExpressionEmitter::copies_before(const std::vector<semantics::CopyBefore>& copies) {
  for (const auto& each : copies) assign(each.target, *each.value);
}

void ExpressionEmitter::copies_after(const std::vector<semantics::CopyAfter>& copies) {
  for (const auto& each : copies) assign(each.target, *each.value);
}

void ExpressionEmitter::wrap(const Type& type) {
  if (type.is_bool() || type.is_real() || type.size >= 4) return;
  const bool is_unsigned = type.is_unsigned();
  if (type.size == 1) b_.emit(is_unsigned ? Opcode::WrapU8 : Opcode::WrapI8);
  if (type.size == 2) b_.emit(is_unsigned ? Opcode::WrapU16 : Opcode::WrapI16);
}

void ExpressionEmitter::unary(const Value& value, Width width) {
  const Type& type = *value.type;
  this->value(*value.operands[0], Width::Any);
  const Machine machine = machine_type(type);
  if (value.op == Operator::Not) {
    if (machine == Machine::Bool) return b_.emit(Opcode::NotBool);
    b_.emit(is_wide(machine) ? Opcode::NotI64 : Opcode::NotI32);
  } else {
    b_.emit(machine == Machine::F32   ? Opcode::NegF32
            : machine == Machine::F64 ? Opcode::NegF64
            : is_wide(machine)        ? Opcode::NegI64
                                      : Opcode::NegI32);
  }
  if (width == Width::Exact) wrap(type);
}

void ExpressionEmitter::operation(Operator op, const Type& operands) {
  if (operands.is_bool() && op == Operator::Equal) {
    b_.emit(Opcode::XorBool);
    return b_.emit(Opcode::NotBool);
  }
  b_.emit(binary_opcode(op, machine_type(operands)));
}

// FALSE < TRUE: compared as numbers.
void ExpressionEmitter::bool_order(const Value& value) {
  for (const auto& each : value.operands) {
    this->value(*each);
    b_.emit(Opcode::BoolToI32);
  }
  b_.emit(binary_opcode(value.op, Machine::U32));
}

void ExpressionEmitter::binary(const Value& value, Width width) {
  const Type& operands = *value.operands[0]->type;
  if (operands.is_bool() && value.op >= Operator::Less && value.op <= Operator::GreaterEqual)
    return bool_order(value);
  const bool modular =
      value.op == Operator::Add || value.op == Operator::Subtract || value.op == Operator::Multiply;
  const bool logic = value.op == Operator::And || value.op == Operator::Or || value.op == Operator::Xor;
  const Width inner = modular || (logic && width == Width::Any) ? Width::Any : Width::Exact;
  const bool divides = value.op == Operator::Divide;
  this->value(*value.operands[0], inner);
  for (std::size_t i = 1; i < value.operands.size(); ++i) {
    this->value(*value.operands[i], inner);
    operation(value.op, operands);
    // A quotient is an operand of the next division: it must be exact (-128 / -1 is not).
    if (divides && i + 1 < value.operands.size()) wrap(operands);
  }
  if ((modular || divides) && width == Width::Exact) wrap(*value.type);
}

void ExpressionEmitter::shift(const Value& value) {
  using semantics::StandardFunction;
  const Type& type = *value.type;
  const bool wide = type.size == 8;
  this->value(*value.operands[0]);
  this->value(*value.operands[1]);
  switch (value.function) {
    case StandardFunction::Shl:
      b_.emit(wide ? Opcode::ShlI64 : Opcode::ShlI32);
      return wrap(type);
    case StandardFunction::Shr:
      return b_.emit(wide ? Opcode::ShrI64 : Opcode::ShrI32);
    case StandardFunction::Rol:
      return wide ? b_.emit(Opcode::RolI64)
                  : b_.rotate_i32(Opcode::RolI32, static_cast<std::uint8_t>(type.bit_count()));
    default:
      return wide ? b_.emit(Opcode::RorI64)
                  : b_.rotate_i32(Opcode::RorI32, static_cast<std::uint8_t>(type.bit_count()));
  }
}

void ExpressionEmitter::select(const Value& value) {
  this->value(*value.operands[1]);
  this->value(*value.operands[2]);
  this->value(*value.operands[0]);
  b_.emit(Opcode::Select);
}

// A chain of selections: every operand is evaluated, as the arguments of any function are.
void ExpressionEmitter::multiplex(const Value& value) {
  const auto count = static_cast<std::int32_t>(value.operands.size() - 1);
  const writer::LocalId selector = b_.add_local(bytecode::StackType::I32);
  this->value(*value.operands[0]);
  b_.local_set(selector);
  const writer::Label in_range = b_.new_label();
  b_.local_get(selector);
  b_.const_i32(count);
  b_.emit(Opcode::LtU32);
  b_.jump_if_true(in_range);
  b_.trap(static_cast<std::uint8_t>(bytecode::TrapCode::IndexRange));
  b_.bind(in_range);
  this->value(*value.operands[1]);
  for (std::int32_t i = 1; i < count; ++i) {
    this->value(*value.operands[static_cast<std::size_t>(i) + 1]);
    b_.local_get(selector);
    b_.const_i32(i);
    b_.emit(Opcode::EqI32);
    b_.emit(Opcode::Select);
  }
}

}  // namespace stepwright::codegen
