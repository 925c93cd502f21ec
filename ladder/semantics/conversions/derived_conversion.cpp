// What may be assigned to enumerations, subranges, references, strings and aggregates (IEC 61131-3, 6.4.4).

#include <algorithm>
#include <utility>

#include "ladder/semantics/conversions/conversions.h"
#include "ladder/semantics/conversions/text.h"

namespace stepwright::semantics::internal {

namespace {

// The bounds of a value that cannot leave them.
IntegerRange known_range(const Value& value) {
  if (value.kind == ValueKind::Constant) return {value.constant.integer, value.constant.integer};
  const bool kept = value.kind == ValueKind::Load && value.place.type->kind == TypeKind::Subrange;
  return kept ? value.place.type->range : range_of(value.type->elementary);
}

}  // namespace

ValuePtr Conversions::convert_derived(ValuePtr value, const Type* type, Position where, bool& known) {
  known = true;
  const Type& from = *value->type;
  if (from.kind == TypeKind::AnyEnumerator) return convert_enumerator(std::move(value), type, where);
  if (from.kind == TypeKind::Nothing) return mismatch(from, *type, where);
  if (from.kind == TypeKind::Null && type->is_reference())
    return make_constant(value->constant, type, value->where);
  const bool texts = (from.is_string() || is_character(from)) && (type->is_string() || is_character(*type));
  if (texts) return convert_text(std::move(value), type, where);
  if (type->kind == TypeKind::Subrange) return convert_to_subrange(std::move(value), type, where);
  known = false;
  return value;
}

// `type` null: nothing says which enumeration is meant.
ValuePtr Conversions::convert_enumerator(ValuePtr value, const Type* type, Position where) {
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
ValuePtr Conversions::convert_to_subrange(ValuePtr value, const Type* type, Position where) {
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

// To a string or a character. Longer texts are cut.
ValuePtr Conversions::convert_text(ValuePtr value, const Type* type, Position where) {
  const bool narrow_literal = value->kind == ValueKind::Constant && value->type->is_string() &&
                              value->type->elementary == ElementaryType::Wstring && type->is_string() &&
                              type->elementary == ElementaryType::String &&
                              value->type->capacity == value->constant.text.size() &&
                              std::ranges::all_of(value->constant.text, [](char16_t c) { return c < 256; });
  if (narrow_literal && !a_.dialect->double_quotes) {
    a_.error(
        code::kTypeMismatch, where, "expected STRING, found WSTRING",
        source::with_dialects("literals of STRING stand in single quotes", &source::Dialect::double_quotes));
    return nullptr;
  }
  if (narrow_literal)
    value = make_constant(
        value->constant, a_.type_table().string(ElementaryType::String, value->type->capacity), value->where);
  const Type& from = *value->type;
  const bool same_width = width_of(from) == width_of(*type);
  if (!same_width || (!from.is_string() && !type->is_string())) return mismatch(from, *type, where);
  if (!type->is_string())
    return is_single(*value) ? make_constant({value->constant.text[0]}, type, value->where)
                             : mismatch(from, *type, where);
  if (!from.is_string())
    value = text_operation(bytecode::StringOpId::SetCharAtS, a_.type_table().string(type->elementary, 1),
                           std::move(value), where);
  if (value->type->capacity <= type->capacity) return value;
  return text_operation(bytecode::StringOpId::CopyS, type, std::move(value), where);
}

}  // namespace stepwright::semantics::internal
