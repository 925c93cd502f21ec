#include "ladder/codegen/expression_emitter.h"

#include "ladder/codegen/machine_type.h"
#include "ladder/semantics/types/operator_group.h"
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
      return value.type->is_string() ? literal(value.constant.text, *value.type)
                                     : constant(value.constant, *value.type);
    case ValueKind::Load:
      if (!value.place.steps.empty()) locate(value.where);
      return value.place.type->is_scalar() ? load(value.place) : reference(value.place);
    case ValueKind::Reference:
      return reference(value.place);
    case ValueKind::Unary:
      return unary(value, width);
    case ValueKind::Binary:
      return binary(value, width);
    case ValueKind::Convert:
      this->value(*value.operands[0]);
      if (value.operands[0]->type->is_real()) locate(value.where);
      return convert(*value.operands[0]->type, *value.type);
    case ValueKind::Truncate:
      this->value(*value.operands[0]);
      locate(value.where);
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
    case ValueKind::Check:
      return check(value);
    case ValueKind::Call:
      return call(value);
    case ValueKind::Enabled:
      return enabled(value);
    case ValueKind::Chain:
      return chain(value);
    case ValueKind::Fail:
      return b_.trap(static_cast<std::uint8_t>(bytecode::TrapCode::BadArgument));
    case ValueKind::Stop:
      return b_.trap(static_cast<std::uint8_t>(bytecode::TrapCode::UserTrap));
    case ValueKind::Now:
      return b_.emit(Opcode::Now);
    case ValueKind::Text:
      return text(value);
  }
}

void ExpressionEmitter::begin_statement() {
  for (Temporary& each : temporaries_) each.in_use = false;
  for (const auto& [local, type] : statement_locals_) release(local, type);
  statement_locals_.clear();
}

writer::LocalId ExpressionEmitter::local(bytecode::StackType type) {
  const writer::LocalId taken = held_local(type);
  statement_locals_.emplace_back(taken, type);
  return taken;
}

writer::LocalId ExpressionEmitter::held_local(bytecode::StackType type) {
  auto& free = free_locals_[static_cast<std::size_t>(type)];
  if (free.empty()) return b_.add_local(type);
  const writer::LocalId taken = free.back();
  free.pop_back();
  return taken;
}

void ExpressionEmitter::release(writer::LocalId local, bytecode::StackType type) {
  free_locals_[static_cast<std::size_t>(type)].push_back(local);
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
    case Machine::Ref:
      // No other reference is known when the program is compiled.
      return b_.emit(Opcode::ConstNull);
  }
}

void ExpressionEmitter::assign(const Place& place, const Value& value) {
  if (place.type->is_scalar()) return store(place, [&](Width width) { this->value(value, width); });
  if (place.type->is_string()) return assign_text(place, value);
  copy_bytes(place, value);
}

void ExpressionEmitter::copy_bytes(const Place& target, const Value& value) {
  reference(target);
  this->value(value);
  b_.mem_copy(target.type->size);
}

void ExpressionEmitter::copies_before(const std::vector<semantics::CopyBefore>& copies) {
  for (const auto& each : copies) assign(each.target, *each.value);
}

void ExpressionEmitter::copies_after(const std::vector<semantics::CopyAfter>& copies) {
  for (const auto& each : copies) assign(each.target, *each.value);
}

void ExpressionEmitter::call(const Value& value) {
  copies_before(value.before);
  for (const auto& each : value.operands) this->value(*each);
  call_site(value.where, *value.pou);
  b_.call(layout_.functions.at(value.pou));
  copies_after(value.after);
  const bool in_memory = !value.type->is_scalar() && value.type->kind != semantics::TypeKind::Nothing;
  if (in_memory) reference(value.place);
}

void ExpressionEmitter::enabled(const Value& value) {
  const Type& type = *value.type;
  const bool scalar = type.is_scalar();
  const bool nothing = type.kind == semantics::TypeKind::Nothing;
  const writer::Label end = b_.new_label();
  writer::LocalId result;
  copies_before(value.before);
  if (scalar) {
    result = local(semantics::slot_type(type));
    constant(value.constant, type);
    b_.local_set(result);
  } else if (!nothing) {
    copy_bytes(value.place, *value.operands[2]);
  }
  this->value(*value.operands[0]);
  b_.jump_if_false(end);
  if (scalar || nothing) {
    this->value(*value.operands[1]);
    if (scalar) b_.local_set(result);
  } else {
    assign(value.place, *value.operands[1]);
  }
  b_.bind(end);
  copies_after(value.after);
  if (scalar) b_.local_get(result);
  if (!scalar && !nothing) reference(value.place);
}

void ExpressionEmitter::check(const Value& value) {
  this->value(*value.operands[0]);
  locate(value.where);
  check_range(*value.type);
}

void ExpressionEmitter::check_range(const Type& type) {
  const semantics::IntegerRange& range = type.range;
  switch (machine_type(type)) {
    case Machine::U64:
      return b_.check_u64(static_cast<std::uint64_t>(range.low), static_cast<std::uint64_t>(range.high));
    case Machine::I64:
      return b_.check_i64(static_cast<std::int64_t>(range.low), static_cast<std::int64_t>(range.high));
    case Machine::U32:
      if (type.size == 4) return check_udint(range);
      [[fallthrough]];
    default:
      return b_.check_i32(static_cast<std::int32_t>(range.low), static_cast<std::int32_t>(range.high));
  }
}

// On the stack a UDINT is the I32 of its bits: it is compared in 64 bits.
void ExpressionEmitter::check_udint(const semantics::IntegerRange& range) {
  b_.emit(Opcode::U32ToI64);
  b_.check_i64(static_cast<std::int64_t>(range.low), static_cast<std::int64_t>(range.high));
  b_.emit(Opcode::I64ToI32);
}

// The right operand of AND_THEN and OR_ELSE is evaluated only if the left one leaves the result open.
void ExpressionEmitter::short_circuit(const Value& value) {
  const writer::LocalId result = local(bytecode::StackType::Bool);
  const writer::Label end = b_.new_label();
  for (const auto& each : value.operands) {
    this->value(*each);
    b_.local_set(result);
    if (&each == &value.operands.back()) break;
    b_.local_get(result);
    if (value.op == Operator::AndThen) {
      b_.jump_if_false(end);
    } else {
      b_.jump_if_true(end);
    }
  }
  b_.bind(end);
  b_.local_get(result);
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
  if (semantics::is_short_circuit(value.op)) return short_circuit(value);
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
    if (divides || value.op == Operator::Modulo) locate(value.operands[i]->where);
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
  const Value& places = *value.operands[1];
  this->value(*value.operands[0]);
  this->value(places);
  const bool is_unsigned = places.kind == ValueKind::Convert && places.operands.front()->type->is_unsigned();
  if (places.kind != ValueKind::Constant && !is_unsigned) {
    b_.emit(Opcode::Dup);
    b_.const_i32(0);
    b_.emit(Opcode::GeI32);
    locate(value.where);
    trap_unless(bytecode::TrapCode::BadArgument);
  }
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
  const writer::LocalId selector = local(bytecode::StackType::I32);
  this->value(*value.operands[0]);
  b_.local_set(selector);
  const writer::Label in_range = b_.new_label();
  b_.local_get(selector);
  b_.const_i32(count);
  b_.emit(Opcode::LtU32);
  b_.jump_if_true(in_range);
  locate(value.where);
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
