// What may be assigned to enumerations, subranges, references, strings and aggregates (IEC 61131-3, 6.4.4).

#include <utility>

#include "ladder/semantics/internal/expression_analyzer.h"

namespace stepwright::semantics::internal {

namespace {

// The bounds of a value that cannot leave them.
IntegerRange known_range(const Value& value) {
  if (value.kind == ValueKind::Constant) return {value.constant.integer, value.constant.integer};
  const bool kept = value.kind == ValueKind::Load && value.place.type->kind == TypeKind::Subrange;
  return kept ? value.place.type->range : range_of(value.type->elementary);
}

}  // namespace

ValuePtr ExpressionAnalyzer::convert_derived(ValuePtr value, const Type* type, Position where, bool& known) {
  known = true;
  const Type& from = *value->type;
  if (from.kind == TypeKind::AnyEnumerator) return convert_enumerator(std::move(value), type, where);
  if (from.kind == TypeKind::Nothing) return mismatch(from, *type, where);
  if (from.kind == TypeKind::Null && type->is_reference())
    return make_constant(value->constant, type, value->where);
  const auto is_character = [](const Type& each) {
    return each.is(ElementaryType::Char) || each.is(ElementaryType::Wchar);
  };
  const bool texts = (from.is_string() || is_character(from)) && (type->is_string() || is_character(*type));
  if (texts) return convert_text(std::move(value), type, where);
  if (type->kind == TypeKind::Subrange) return convert_to_subrange(std::move(value), type, where);
  known = false;
  return value;
}

// `type` null: nothing says which enumeration is meant.
ValuePtr ExpressionAnalyzer::convert_enumerator(ValuePtr value, const Type* type, Position where) {
  const NameId name(static_cast<std::uint32_t>(value->constant.integer));
  const std::string spelling = a_.names.folded(name);
  if (type == nullptr) {
    a_.error(code::kUndeclared, value->where, quote(spelling) + " is a value of several enumerations",
             "write it with its type: Type#" + spelling);
    return nullptr;
  }
  if (type->kind != TypeKind::Enumeration) return mismatch(*value->type, *type, where);
  if (const Enumerator* found = type->find_enumerator(name))
    return make_constant({found->value}, type, value->where);
  a_.unknown_name(code::kUnknownMember, pou_, value->where,
                  quote(type->name) + " has no value " + quote(spelling));
  return nullptr;
}

// Checked when the program runs, unless the value cannot be out of the range.
ValuePtr ExpressionAnalyzer::convert_to_subrange(ValuePtr value, const Type* type, Position where) {
  value = convert(std::move(value), type->base, where);
  if (!value) return nullptr;
  const IntegerRange held = known_range(*value);
  const bool inside = held.low >= type->range.low && held.high <= type->range.high;
  if (value->kind == ValueKind::Constant) {
    if (inside) return make_constant(value->constant, type, value->where);
    a_.error(code::kOutOfRange, where, to_string(held.low) + " is out of the range of " + type->name,
             "it goes from " + to_string(type->range.low) + " to " + to_string(type->range.high));
    return nullptr;
  }
  if (inside) return value;
  ValuePtr checked = make(ValueKind::Check, type, where);
  checked->operands.push_back(std::move(value));
  return checked;
}

}  // namespace stepwright::semantics::internal
