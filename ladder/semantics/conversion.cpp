// Implicit and explicit conversions (IEC 61131-3, 6.6.1.6 and 6.6.2.5.3).

#include <cmath>
#include <utility>

#include "ladder/semantics/internal/expression_analyzer.h"

namespace stepwright::semantics::internal {

namespace {

std::string conversion_hint(const Type& from, const Type& to) {
  const bool elementary = from.kind == TypeKind::Elementary && to.kind == TypeKind::Elementary;
  return elementary ? "convert it with " + from.name + "_TO_" + to.name + "(...)" : "";
}

bool is_whole(const Type& type) {
  return type.is_integer() || type.is_bits() || type.is_bool();
}

}  // namespace

ValuePtr ExpressionAnalyzer::mismatch(const Type& from, const Type& to, Position where) {
  std::string hint = conversion_hint(from, to);
  if (to.is_time() && from.is_literal()) hint = "durations are written T#1s500ms";
  if (from.kind == TypeKind::AnyReal && to.is_integer()) hint = "round it, or declare the variable as REAL";
  a_.error(code::kTypeMismatch, where, "expected " + to.name + ", found " + from.name, std::move(hint));
  return nullptr;
}

ValuePtr ExpressionAnalyzer::convert(ValuePtr value, const Type* type, Position where) {
  if (!value || type == nullptr || value->type == type) return value;
  bool known = false;
  value = convert_derived(std::move(value), type, where, known);
  if (known) return value;
  if (value->type->is_literal()) return convert_literal(std::move(value), type, where);
  if (!widens(*value->type, *type)) return mismatch(*value->type, *type, where);
  return convert_exactly(std::move(value), type);
}

ValuePtr ExpressionAnalyzer::convert_literal(ValuePtr value, const Type* type, Position where) {
  Constant constant = value->constant;
  if (type->is_real()) {
    if (value->type->kind == TypeKind::AnyInteger) constant = {0, static_cast<double>(constant.integer)};
    if (type->is(ElementaryType::Real) && std::isinf(static_cast<float>(constant.real))) {
      a_.error(code::kOutOfRange, where, "the number is too large for REAL", "use LREAL");
      return nullptr;
    }
    return make_constant(wrapped(constant, *type), type, value->where);
  }
  if (value->type->kind != TypeKind::AnyInteger || type->kind != TypeKind::Elementary || type->is_time())
    return mismatch(*value->type, *type, where);
  if (!fits(constant, *type)) {
    if (type->is_bool()) return mismatch(*value->type, *type, where);
    const IntegerRange range = range_of(type->elementary);
    a_.error(code::kOutOfRange, where, to_string(constant.integer) + " is out of the range of " + type->name,
             type->name + " goes from " + to_string(range.low) + " to " + to_string(range.high));
    return nullptr;
  }
  return make_constant(constant, type, value->where);
}

// Requires a conversion that the language has; folds constants.
ValuePtr ExpressionAnalyzer::convert_exactly(ValuePtr value, const Type* type) {
  const Type& from = *value->type;
  if (&from == type) return value;
  if (value->kind == ValueKind::Constant && !from.is_time() && !type->is_time()) {
    const Constant constant = value->constant;
    if (is_whole(from) && type->is_real())
      return make_constant(wrapped({0, static_cast<double>(constant.integer)}, *type), type, value->where);
    if (from.is_real() && type->is_real()) return make_constant(wrapped(constant, *type), type, value->where);
    if (is_whole(from) && type->is_bool())
      return make_constant({constant.integer != 0 ? 1 : 0}, type, value->where);
    if (is_whole(from) && is_whole(*type)) return make_constant(wrapped(constant, *type), type, value->where);
    if (from.is_real() && type->is_integer() && std::abs(constant.real) < 9e18) {
      const Constant rounded{static_cast<__int128>(std::nearbyint(constant.real))};
      if (fits(rounded, *type)) return make_constant(rounded, type, value->where);
    }
  }
  ValuePtr converted = make(ValueKind::Convert, type, value->where);
  converted->operands.push_back(std::move(value));
  return converted;
}

bool ExpressionAnalyzer::is_conversion(const std::string& folded, const Type*& from, const Type*& to) const {
  const std::size_t middle = folded.find("_TO_");
  const bool generic = folded.rfind("TO_", 0) == 0;
  if (!generic && middle == std::string::npos) return false;
  ElementaryType source{};
  ElementaryType target{};
  if (!elementary_from(folded.substr(generic ? 3 : middle + 4), target)) return false;
  if (!generic && !elementary_from(folded.substr(0, middle), source)) return false;
  from = generic ? nullptr : a_.type_table().elementary(source);
  to = a_.type_table().elementary(target);
  return true;
}

ValuePtr ExpressionAnalyzer::explicit_conversion(const syntax::Expression& call, const Type* from,
                                                 const Type* to) {
  auto arguments = standard_arguments(call, {"IN"}, 1, 1);
  if (!arguments) return nullptr;
  ValuePtr value = from != nullptr
                       ? convert(std::move(arguments->front()), from, call.arguments[0].value->where)
                       : settle(std::move(arguments->front()));
  if (!value) return nullptr;
  // An enumeration is converted by its number.
  if (value->type->kind == TypeKind::Enumeration) {
    ValuePtr number = make(ValueKind::Convert, a_.type_table().elementary(ElementaryType::Int), value->where);
    number->operands.push_back(std::move(value));
    value = std::move(number);
  }
  const bool time_and_bool =
      (value->type->is_time() && to->is_bool()) || (value->type->is_bool() && to->is_time());
  if (!value->type->is_scalar() || time_and_bool) return mismatch(*value->type, *to, call.where);
  return convert_exactly(std::move(value), to);
}

}  // namespace stepwright::semantics::internal
