// Functions of strings (IEC 61131-3, 6.6.2.5.11, table 34).

#include <algorithm>
#include <utility>

#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace stepwright::semantics::internal {

using bytecode::StringOpId;
using syntax::Expression;

namespace {

constexpr int id(StringOpId op) {
  return static_cast<int>(op);
}

// Results of LEN and FIND are INT as far as that goes.
constexpr std::uint32_t kMostOfInt = 0x7FFF;

}  // namespace

std::span<const StandardAnalyzer::Entry> StandardAnalyzer::text_entries() {
  using S = StandardAnalyzer;
  constexpr std::size_t kAll = 1000;
  static constexpr Entry kEntries[] = {
      {"LEN", "IN", 1, &S::measure, id(StringOpId::LengthS), 0, 1},
      {"FIND", "IN1 IN2", 2, &S::measure, id(StringOpId::FindS), 0, 2},
      {"CONCAT", "IN1 IN2+", 2, &S::join, id(StringOpId::ConcatS), 0, kAll},
      {"INSERT", "IN1 IN2 P", 3, &S::join, id(StringOpId::InsertS), 0, 2},
      {"REPLACE", "IN1 IN2 L P", 4, &S::join, id(StringOpId::ReplaceS), 0, 2},
      {"LEFT", "IN L", 2, &S::cut, id(StringOpId::LeftS), 0, 1},
      {"RIGHT", "IN L", 2, &S::cut, id(StringOpId::RightS), 0, 1},
      {"MID", "IN L P", 3, &S::cut, id(StringOpId::MidS), 0, 1},
      {"DELETE", "IN L P", 3, &S::cut, id(StringOpId::DeleteS), 0, 1},
  };
  return kEntries;
}

// The first `texts` values as strings of one width, the others as numbers of characters; the sum of the
// capacities, or nothing after a report.
std::optional<std::uint32_t> StandardAnalyzer::text_operands(const Expression& call, Values& values,
                                                             std::size_t texts) {
  const TypeTable& types = a_.type_table();
  const Type& first = *values[0]->type;
  const bool wide = first.is(ElementaryType::Wchar) || first.elementary == ElementaryType::Wstring;
  const Type* text = a_.type_table().string(wide ? ElementaryType::Wstring : ElementaryType::String,
                                            bytecode::kMaxStringCapacity);
  std::uint32_t capacity = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Position where = values[i]->where;
    if (i < texts) {
      const bool is_text = values[i]->type->is_string() || values[i]->type->is(ElementaryType::Char) ||
                           values[i]->type->is(ElementaryType::Wchar);
      if (!is_text) {
        wrong_operand(call, *values[i]->type, "convert it with TO_STRING(...)");
        return std::nullopt;
      }
      values[i] = e_.conversions().convert(std::move(values[i]), text, where);
      if (!values[i]) return std::nullopt;
      capacity = std::min(capacity + values[i]->type->capacity, bytecode::kMaxStringCapacity);
      continue;
    }
    values[i] = e_.conversions().bits().counted(e_.conversions().settle(std::move(values[i])));
    if (!values[i]) return std::nullopt;
    if (!values[i]->type->is_integer()) {
      e_.conversions().mismatch(*values[i]->type, *types.elementary(ElementaryType::Int), where);
      return std::nullopt;
    }
    // No string is longer than the bound.
    values[i] = as_dint(std::move(values[i]), -1, bytecode::kMaxStringCapacity + 1);
    if (values[i]->kind == ValueKind::Constant && values[i]->constant.integer < 0) {
      a_.error(code::kOutOfRange, where, "the number of characters is negative");
      return std::nullopt;
    }
  }
  return capacity;
}

ValuePtr StandardAnalyzer::measure(const Expression& call, Values values, int which) {
  const auto capacity = text_operands(call, values, values.size());
  if (!capacity) return nullptr;
  const bool small = values[0]->type->capacity <= kMostOfInt;
  const Type* type = a_.type_table().elementary(small ? ElementaryType::Int : ElementaryType::Dint);
  return text_operation(static_cast<StringOpId>(which), type, std::move(values), call.where);
}

ValuePtr StandardAnalyzer::join(const Expression& call, Values values, int which) {
  const auto op = static_cast<StringOpId>(which);
  const auto capacity = text_operands(call, values, op == StringOpId::ConcatS ? values.size() : 2);
  if (!capacity) return nullptr;
  const Type* type = a_.type_table().string(values[0]->type->elementary, *capacity);
  return text_operation(op, type, std::move(values), call.where);
}

ValuePtr StandardAnalyzer::cut(const Expression& call, Values values, int which) {
  auto capacity = text_operands(call, values, 1);
  if (!capacity) return nullptr;
  const auto op = static_cast<StringOpId>(which);
  const bool takes = op != StringOpId::DeleteS && values[1]->kind == ValueKind::Constant;
  if (takes && values[1]->constant.integer < *capacity)
    capacity = static_cast<std::uint32_t>(values[1]->constant.integer);
  const Type* type = a_.type_table().string(values[0]->type->elementary, *capacity);
  return text_operation(op, type, std::move(values), call.where);
}

}  // namespace stepwright::semantics::internal
