// Selection functions (IEC 61131-3, 6.6.2.5.10, table 32).

#include <utility>

#include "ladder/semantics/constants/constant_function.h"
#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

std::span<const StandardAnalyzer::Entry> StandardAnalyzer::selection_entries() {
  using S = StandardAnalyzer;
  constexpr std::size_t kAll = 1000;
  static constexpr Entry kEntries[] = {
      {"MIN", "IN1 IN2+", 2, &S::extremum, static_cast<int>(StandardFunction::Min), 0, kAll},
      {"MAX", "IN1 IN2+", 2, &S::extremum, static_cast<int>(StandardFunction::Max), 0, kAll},
      {"LIMIT", "MN IN MX", 3, &S::limit, 0, 0, 3},
      {"SEL", "G IN0 IN1", 3, &S::select, 0, 1, 2},
      {"MUX", "K IN0+", 2, &S::multiplex, 0, 1, kAll},
  };
  return kEntries;
}

namespace {

bool has_order(const Type& type) {
  return type.kind == TypeKind::Elementary || type.is_integer() || type.is_literal() || type.is_string();
}

bool is_selectable(const Type& type) {
  return type.kind != TypeKind::Instance && type.kind != TypeKind::Nothing && !type.open;
}

}  // namespace

ValuePtr StandardAnalyzer::extremum(const Expression& call, Values values, int which) {
  const Type* type = unify(values, 0, call.where);
  if (type == nullptr) return nullptr;
  if (!has_order(*type)) return wrong_operand(call, *type);
  return make_standard(static_cast<StandardFunction>(which), type, std::move(values), call.where);
}

// LIMIT(MN, IN, MX) = MIN(MAX(IN, MN), MX)
ValuePtr StandardAnalyzer::limit(const Expression& call, Values values, int) {
  const Type* type = unify(values, 0, call.where);
  if (type == nullptr) return nullptr;
  if (!has_order(*type)) return wrong_operand(call, *type);
  Values lower;
  lower.push_back(std::move(values[1]));
  lower.push_back(std::move(values[0]));
  Values upper;
  upper.push_back(make_standard(StandardFunction::Max, type, std::move(lower), call.where));
  upper.push_back(std::move(values[2]));
  return make_standard(StandardFunction::Min, type, std::move(upper), call.where);
}

ValuePtr StandardAnalyzer::select(const Expression& call, Values values, int) {
  values[0] = e_.conversions().convert(std::move(values[0]), a_.type_table().boolean(), call.where);
  if (!values[0]) return nullptr;
  const Type* type = unify(values, 1, call.where);
  if (type == nullptr) return nullptr;
  if (!is_selectable(*type)) return wrong_operand(call, *type);
  const bool constant = values[0]->kind == ValueKind::Constant;
  if (constant && values[1]->kind == ValueKind::Constant && values[2]->kind == ValueKind::Constant)
    return std::move(values[values[0]->constant.integer != 0 ? 2 : 1]);
  ValuePtr result = make(ValueKind::Select, type, call.where);
  result->constant = widest_of(std::span(values).subspan(1));
  result->operands = std::move(values);
  return result;
}

ValuePtr StandardAnalyzer::multiplex(const Expression& call, Values values, int) {
  values[0] = as_dint(std::move(values[0]), -1, static_cast<__int128>(values.size()));
  if (!values[0]) return nullptr;
  const Type* type = unify(values, 1, call.where);
  if (type == nullptr) return nullptr;
  if (!is_selectable(*type)) return wrong_operand(call, *type);
  if (values[0]->kind == ValueKind::Constant) {
    const __int128 number = values[0]->constant.integer;
    if (number < 0 || number > static_cast<__int128>(values.size()) - 2) {
      a_.error(code::kConstantIndex, values[0]->where, "MUX has no input IN" + to_string(number),
               "K goes from 0 to " + std::to_string(values.size() - 2));
      return nullptr;
    }
  }
  ValuePtr result = make(ValueKind::Multiplex, type, call.where);
  result->constant = widest_of(std::span(values).subspan(1));
  result->operands = std::move(values);
  return result;
}

}  // namespace stepwright::semantics::internal
