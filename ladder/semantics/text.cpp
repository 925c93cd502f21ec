// Strings and characters: literals, comparison, single characters, implicit conversion (IEC 61131-3, 6.3.3,
// 6.4.2 and table 6).

#include <algorithm>
#include <utility>

#include "ladder/semantics/constant_text.h"
#include "ladder/semantics/internal/expression_analyzer.h"

namespace stepwright::semantics::internal {

using bytecode::StringOpId;
using syntax::Expression;
using syntax::ExpressionKind;
using syntax::Operator;

namespace {

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

}  // namespace

// 'abc' or "abc"
ValuePtr ExpressionAnalyzer::text_literal(const Expression& expression) {
  const bool wide = expression.kind == ExpressionKind::WideString;
  if (expression.characters.size() > bytecode::kMaxStringCapacity) {
    a_.error(code::kLiteralRange, expression.where, "a string has at most 65535 characters");
    return nullptr;
  }
  const Type* type = a_.type_table().string(wide ? ElementaryType::Wstring : ElementaryType::String,
                                            static_cast<std::uint32_t>(expression.characters.size()));
  return make_constant({0, 0, expression.characters}, type, expression.where);
}

ValuePtr ExpressionAnalyzer::text_operation(StringOpId narrow, const Type* type,
                                            std::vector<ValuePtr> operands, Position where) {
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

ValuePtr ExpressionAnalyzer::text_operation(StringOpId narrow, const Type* type, ValuePtr operand,
                                            Position where) {
  std::vector<ValuePtr> operands;
  operands.push_back(std::move(operand));
  return text_operation(narrow, type, std::move(operands), where);
}

// The type of both: the longer string; of a string and a character the string, unless that is one character.
const Type* ExpressionAnalyzer::common_text(const Value& left, const Value& right) const {
  const Type& l = *left.type;
  const Type& r = *right.type;
  const bool texts = (l.is_string() || is_character(l)) && (r.is_string() || is_character(r));
  if (!texts || width_of(l) != width_of(r)) return nullptr;
  if (!l.is_string()) return is_single(right) ? &l : &r;
  if (!r.is_string()) return is_single(left) ? &r : &l;
  return l.capacity >= r.capacity ? &l : &r;
}

ValuePtr ExpressionAnalyzer::compare_texts(Operator op, ValuePtr left, ValuePtr right, Position where) {
  const Type* text = common_text(*left, *right);
  const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
  std::vector<ValuePtr> operands;
  operands.push_back(convert(std::move(left), text, where));
  operands.push_back(convert(std::move(right), text, where));
  ValuePtr order = text_operation(StringOpId::CompareS, dint, std::move(operands), where);
  return combine(op, std::move(order), make_constant({}, dint, where), where);
}

// To a string or a character. Longer texts are cut.
ValuePtr ExpressionAnalyzer::convert_text(ValuePtr value, const Type* type, Position where) {
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
    value = text_operation(StringOpId::SetCharAtS, a_.type_table().string(type->elementary, 1),
                           std::move(value), where);
  if (value->type->capacity <= type->capacity) return value;
  return text_operation(StringOpId::CopyS, type, std::move(value), where);
}

// s[i]
std::optional<Place> ExpressionAnalyzer::character_place(Place text, const Expression& expression) {
  if (expression.operands.size() != 2) {
    a_.error(code::kIndexCount, expression.where, "a string has one index, the position of a character");
    return std::nullopt;
  }
  const Expression& index = *expression.operands[1];
  ValuePtr position = index_value(index);
  if (!position) return std::nullopt;
  const bool of_any_length = text.base == Base::ThisRef || text.base == Base::SlotRef;
  const std::uint32_t most = of_any_length ? bytecode::kMaxStringCapacity : text.type->capacity;
  const __int128 number = position->constant.integer;
  const bool constant = position->kind == ValueKind::Constant;
  if (constant && (number < 1 || number > static_cast<__int128>(most))) {
    a_.error(code::kConstantIndex, index.where, "the string has no character " + to_string(number),
             "positions go from 1 to " + std::to_string(most));
    return std::nullopt;
  }
  const Dimension bounds{1, static_cast<std::int32_t>(most)};
  text.character =
      constant ? make_constant({number}, a_.type_table().elementary(ElementaryType::Dint), position->where)
               : narrow_index(std::move(position), bounds);
  text.type = a_.type_table().elementary(
      width_of(*text.type) == ElementaryType::Wstring ? ElementaryType::Wchar : ElementaryType::Char);
  return text;
}

}  // namespace stepwright::semantics::internal
