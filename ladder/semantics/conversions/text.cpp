// What strings and characters share (IEC 61131-3, 6.3.3, 6.4.2 and table 6).

#include "ladder/semantics/conversions/text.h"

#include <utility>

#include "ladder/semantics/constants/constant_text.h"
#include "ladder/semantics/conversions/make_value.h"

namespace stepwright::semantics::internal {

using bytecode::StringOpId;

bool is_character(const Type& type) {
  return type.is(ElementaryType::Char) || type.is(ElementaryType::Wchar);
}

// STRING for a STRING and a CHAR, WSTRING for the wide ones.
ElementaryType width_of(const Type& type) {
  const bool wide = type.elementary == ElementaryType::Wstring || type.elementary == ElementaryType::Wchar;
  return wide ? ElementaryType::Wstring : ElementaryType::String;
}

// One character as it is written; a constant that happens to hold one is declared as a string.
bool is_single(const Value& value) {
  return value.kind == ValueKind::Constant && value.constant.text.size() == 1 && value.type->capacity == 1;
}

ValuePtr text_operation(StringOpId narrow, const Type* type, std::vector<ValuePtr> operands,
                        source::Position where) {
  bool constant = true;
  for (const ValuePtr& each : operands) constant = constant && each->kind == ValueKind::Constant;
  if (constant) {
    std::vector<Constant> values;
    for (const ValuePtr& each : operands) values.push_back(each->constant);
    if (auto folded = evaluate_text(narrow, values, *type))
      return make_constant(std::move(*folded), type, where);
  }
  const bool between = narrow == StringOpId::StringToWstring || narrow == StringOpId::WstringToString;
  const bool wide = width_of(type->is_string() ? *type : *operands[0]->type) == ElementaryType::Wstring;
  ValuePtr result = make(ValueKind::Text, type, where);
  result->text_op =
      between ? narrow : static_cast<StringOpId>(static_cast<std::uint8_t>(narrow) + (wide ? 1 : 0));
  result->operands = std::move(operands);
  return result;
}

ValuePtr text_operation(StringOpId narrow, const Type* type, ValuePtr operand, source::Position where) {
  std::vector<ValuePtr> operands;
  operands.push_back(std::move(operand));
  return text_operation(narrow, type, std::move(operands), where);
}

// The type of both: the longer string; of a string and a character the string, unless that is one character.
const Type* common_text(const Value& left, const Value& right) {
  const Type& l = *left.type;
  const Type& r = *right.type;
  const bool texts = (l.is_string() || is_character(l)) && (r.is_string() || is_character(r));
  if (!texts || width_of(l) != width_of(r)) return nullptr;
  if (!l.is_string()) return is_single(right) ? &l : &r;
  if (!r.is_string()) return is_single(left) ? &r : &l;
  return l.capacity >= r.capacity ? &l : &r;
}

}  // namespace stepwright::semantics::internal
