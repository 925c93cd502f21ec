// Conversions between strings and everything else (IEC 61131-3, 6.6.2.5.4, tables 22 and 23).

#include <utility>

#include "ladder/semantics/conversions/explicit_conversions.h"
#include "ladder/semantics/conversions/text.h"

namespace stepwright::semantics::internal {

using bytecode::StringOpId;
using enum bytecode::ElementaryType;

namespace {

struct Row {
  ElementaryType type;
  StringOpId write;
  StringOpId read;
  std::uint32_t longest;  // characters of a text
};

constexpr Row kRows[] = {
    {Bool, StringOpId::FromBoolS, StringOpId::ToBoolS, 5},
    {Real, StringOpId::FromF32S, StringOpId::ToF32S, 32},
    {Lreal, StringOpId::FromF64S, StringOpId::ToF64S, 32},
    {Time, StringOpId::FromTimeS, StringOpId::ToTimeS, 48},
    {Date, StringOpId::FromDateS, StringOpId::ToDateS, 16},
    {Tod, StringOpId::FromTodS, StringOpId::ToTodS, 32},
    {Dt, StringOpId::FromDtS, StringOpId::ToDtS, 40},
    {Lint, StringOpId::FromI64S, StringOpId::ToI64S, 20},
    {Ulint, StringOpId::FromU64S, StringOpId::ToU64S, 20},
};

// How values of the type are written and read; null if they are not. Integers are as wide as it gets.
const Row* row_of(const Type& type) {
  if (type.kind != TypeKind::Elementary) return nullptr;
  ElementaryType which = type.elementary;
  if (type.is_integer() || type.is_bits()) which = type.is_unsigned() ? Ulint : Lint;
  for (const Row& row : kRows)
    if (row.type == which) return &row;
  return nullptr;
}

}  // namespace

ValuePtr ExplicitConversions::text_conversion(ValuePtr value, const Type* to,
                                              const syntax::Expression& call) {
  const Type* from = value->type;
  ValuePtr result;
  if (from->is_string() && to->is_string()) {
    if (from->elementary == to->elementary) return value;
    const bool widens = to->elementary == Wstring;
    return text_operation(widens ? StringOpId::StringToWstring : StringOpId::WstringToString,
                          a_.type_table().string(to->elementary, from->capacity), std::move(value),
                          call.where);
  }
  if (to->is_string()) return to_text(std::move(value), to, call);
  if (is_character(*to)) {
    if ((from->elementary == Wstring) != to->is(Wchar)) return no_conversion(*from, *to, call);
    std::vector<ValuePtr> operands;
    operands.push_back(std::move(value));
    operands.push_back(make_constant({1}, a_.type_table().elementary(Dint), call.where));
    return text_operation(StringOpId::CharAtS, to, std::move(operands), call.where);
  }
  const Row* row = row_of(*to);
  if (row == nullptr) return no_conversion(*from, *to, call);
  const bool constant = value->kind == ValueKind::Constant;
  result = text_operation(row->read, to, std::move(value), call.where);
  if (constant && result->kind != ValueKind::Constant) {
    a_.error(code::kOutOfRange, call.arguments[0].value->where, "the text is no literal of " + to->name,
             "the text is the whole literal, without blanks");
    return nullptr;
  }
  return result;
}

// A value as the literal that stands for it.
ValuePtr ExplicitConversions::to_text(ValuePtr value, const Type* to, const syntax::Expression& call) {
  const TypeTable& types = a_.type_table();
  if (is_character(*value->type)) {
    const Type* character = types.elementary(to->elementary == Wstring ? Wchar : Char);
    return c_.convert_text(convert_exactly(std::move(value), character), to, call.where);
  }
  const Row* row = row_of(*value->type);
  if (row == nullptr) return no_conversion(*value->type, *to, call);
  value = convert_exactly(std::move(value), types.elementary(row->type));
  return text_operation(row->write, a_.type_table().string(to->elementary, row->longest), std::move(value),
                        call.where);
}

ValuePtr ExplicitConversions::no_conversion(const Type& from, const Type& to, const syntax::Expression& call,
                                            std::string hint) {
  a_.error(code::kTypeMismatch, call.where,
           "there is no conversion from " + plain_name(from) + " to " + plain_name(to), std::move(hint));
  return nullptr;
}

}  // namespace stepwright::semantics::internal
