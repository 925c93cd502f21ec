// Implicit conversions (IEC 61131-3, 6.6.1.6), and the types of literals.

#include "ladder/semantics/conversions/conversions.h"

#include <cmath>
#include <utility>

#include "ladder/semantics/constants/constant_conversion.h"

namespace stepwright::semantics::internal {

namespace {

std::string conversion_hint(const Type& from, const Type& to) {
  const auto is_text = [](const Type& type) { return type.is_string() || type.kind == TypeKind::Elementary; };
  if (to.is_string() && from.is_string())
    return to.elementary == ElementaryType::Wstring
               ? "literals of WSTRING stand in double quotes; else convert it with STRING_TO_WSTRING(...)"
               : "literals of STRING stand in single quotes; else convert it with WSTRING_TO_STRING(...)";
  if (to.is_string() && is_text(from)) return "convert it with TO_" + plain_name(to) + "(...)";
  if (from.is_string() && is_text(to)) return "convert it with TO_" + to.name + "(...)";
  const bool elementary = from.kind == TypeKind::Elementary && to.kind == TypeKind::Elementary;
  return elementary ? "convert it with " + from.name + "_TO_" + to.name + "(...)" : "";
}

}  // namespace

ValuePtr Conversions::mismatch(const Type& from, const Type& to, Position where) {
  std::string hint = conversion_hint(from, to);
  if (to.is_time() && from.is_literal()) hint = "durations are written T#1s500ms";
  if (from.kind == TypeKind::AnyReal && to.is_integer()) hint = "round it, or declare the variable as REAL";
  if (bits_.exchanges_bits(from, to))
    hint = source::with_dialects(std::move(hint), &source::Dialect::bits_calculate);
  a_.error(code::kTypeMismatch, where, "expected " + plain_name(to) + ", found " + plain_name(from),
           std::move(hint));
  return nullptr;
}

ValuePtr Conversions::convert(ValuePtr value, const Type* type, Position where) {
  if (!value || type == nullptr || value->type == type) return value;
  if (adapts_to(*value, *type)) return adapted(std::move(value), type);
  if (type->is_reference()) {
    Value target;
    target.type = type;
    value = null_beside(std::move(value), target);
  }
  bool known = false;
  value = convert_derived(std::move(value), type, where, known);
  if (known) return value;
  if (value->type->is_literal()) return convert_literal(std::move(value), type, where);
  if (widens(*value->type, *type)) return convert_exactly(std::move(value), type);
  if (!a_.dialect->bits_calculate || !bits_.exchanges_bits(*value->type, *type))
    return mismatch(*value->type, *type, where);
  return convert_exactly(bits_.counted(std::move(value)), type);
}

bool Conversions::adapts_to(const Value& value, const Type& type) {
  if (!value.adapts || type.kind != TypeKind::Elementary) return false;
  return value.kind == ValueKind::Truncate ? type.is_integer() : type.is(ElementaryType::Real);
}

ValuePtr Conversions::adapted(ValuePtr value, const Type* type) {
  value->adapts = false;
  if (value->kind != ValueKind::Truncate) return convert_exactly(std::move(value), type);
  value->type = type;
  return value;
}

// A function of literals that is no constant: SEL(b, 1, 2). Its operands get the type.
ValuePtr Conversions::retype(ValuePtr value, const Type* type, Position where) {
  for (ValuePtr& each : value->operands) {
    if (!each->type->is_literal()) continue;
    each = convert(std::move(each), type, where);
    if (!each) return nullptr;
  }
  value->type = type;
  return value;
}

ValuePtr Conversions::convert_literal(ValuePtr value, const Type* type, Position where) {
  if (type->is_literal() && value->kind != ValueKind::Constant) return retype(std::move(value), type, where);
  if (type->kind == TypeKind::AnyReal)
    return make_constant({0, static_cast<double>(value->constant.integer)}, type, value->where);
  Constant constant = value->constant;
  if (type->is_real()) {
    if (value->kind != ValueKind::Constant) return retype(std::move(value), type, where);
    if (value->type->kind == TypeKind::AnyInteger) constant = {0, static_cast<double>(constant.integer)};
    if (type->is(ElementaryType::Real) && std::isinf(static_cast<float>(constant.real)) &&
        std::isfinite(constant.real)) {
      a_.error(code::kOutOfRange, where, "the number is too large for REAL", "use LREAL");
      return nullptr;
    }
    return make_constant(wrapped(constant, *type), type, value->where);
  }
  const bool takes_numbers = type->is_integer() || type->is_bits() || type->is_bool();
  if (value->type->kind != TypeKind::AnyInteger || type->kind != TypeKind::Elementary || !takes_numbers)
    return mismatch(*value->type, *type, where);
  if (value->kind != ValueKind::Constant) return retype(std::move(value), type, where);
  if (!fits(constant, *type)) {
    if (type->is_bool()) return mismatch(*value->type, *type, where);
    const IntegerRange range = range_of(type->elementary);
    a_.error(code::kOutOfRange, where, to_string(constant.integer) + " is out of the range of " + type->name,
             type->name + " goes from " + to_string(range.low) + " to " + to_string(range.high));
    return nullptr;
  }
  return make_constant(constant, type, value->where);
}

ValuePtr Conversions::settle(ValuePtr value) {
  if (value && value->type->kind == TypeKind::AnyEnumerator)
    return convert_enumerator(std::move(value), nullptr, Position());
  if (!value || !value->type->is_literal()) return value;
  const TypeTable& types = a_.type_table();
  const Position where = value->where;
  if (value->type->kind == TypeKind::AnyReal)
    return convert(std::move(value), types.elementary(ElementaryType::Real), where);
  for (const auto which : {ElementaryType::Int, ElementaryType::Dint, ElementaryType::Lint})
    if (fits(value->constant, *types.elementary(which)))
      return convert(std::move(value), types.elementary(which), where);
  return convert(std::move(value), types.elementary(ElementaryType::Ulint), where);
}

// An integer is converted to the narrowest real type that holds all of its values.
ValuePtr Conversions::as_real(ValuePtr value) {
  value = settle(std::move(value));
  if (!value || value->type->is_real()) return value;
  const TypeTable& types = a_.type_table();
  const Type* real = types.elementary(ElementaryType::Real);
  if (!widens(*value->type, *real)) real = types.elementary(ElementaryType::Lreal);
  return convert_exactly(std::move(value), real);
}

ValuePtr Conversions::null_beside(ValuePtr value, const Value& other) const {
  const bool is_zero = value->kind == ValueKind::Constant && value->type->kind == TypeKind::AnyInteger &&
                       value->constant.integer == 0;
  if (!a_.dialect->pointers || !is_zero || !other.type->is_reference()) return value;
  return make_constant({bytecode::kNullRef}, a_.type_table().null(), value->where);
}

}  // namespace stepwright::semantics::internal
