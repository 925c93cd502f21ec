// Numeric functions (IEC 61131-3, 6.6.2.5.6, tables 28 and 29), EXPT and the validity of reals (table 39).

#include <algorithm>
#include <utility>

#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;

namespace {

constexpr int id(StandardFunction function) {
  return static_cast<int>(function);
}

}  // namespace

std::span<const StandardAnalyzer::Entry> StandardAnalyzer::numeric_entries() {
  using enum StandardFunction;
  using S = StandardAnalyzer;
  static constexpr Entry kEntries[] = {
      {"ABS", "IN", 1, &S::numeric, id(Abs), 0, 1},
      {"SQRT", "IN", 1, &S::real_function, id(Sqrt), 0, 1},
      {"LN", "IN", 1, &S::real_function, id(Ln), 0, 1},
      {"LOG", "IN", 1, &S::real_function, id(Log), 0, 1},
      {"EXP", "IN", 1, &S::real_function, id(Exp), 0, 1},
      {"SIN", "IN", 1, &S::real_function, id(Sin), 0, 1},
      {"COS", "IN", 1, &S::real_function, id(Cos), 0, 1},
      {"TAN", "IN", 1, &S::real_function, id(Tan), 0, 1},
      {"ASIN", "IN", 1, &S::real_function, id(Asin), 0, 1},
      {"ACOS", "IN", 1, &S::real_function, id(Acos), 0, 1},
      {"ATAN", "IN", 1, &S::real_function, id(Atan), 0, 1},
      {"ATAN2", "Y X", 2, &S::real_function, id(Atan2), 0, 2},
      {"EXPT", "IN1 IN2", 2, &S::power, 0, 0, 1},
      {"TRUNC", "IN", 1, &S::truncate, 0, 0, 0},
      {"IS_VALID", "IN", 1, &S::is_valid, 0, 0, 1},
  };
  return kEntries;
}

ValuePtr StandardAnalyzer::numeric(const Expression& call, Values values, int which) {
  values[0] = e_.conversions().bits().counted(std::move(values[0]));
  const Type* type = values[0]->type;
  if (!type->is_number()) return wrong_operand(call, *type, e_.conversions().bits().bits_hint(*type));
  return make_standard(static_cast<StandardFunction>(which), type, std::move(values), call.where);
}

// Literals are computed without a type, in double: 4.0 * ATAN(1.0) is as near to pi as an LREAL comes.
bool StandardAnalyzer::as_reals(const Expression& call, Values& values) {
  const bool literals = std::ranges::all_of(values, [](const ValuePtr& each) {
    return each->type->is_literal() && each->kind == ValueKind::Constant;
  });
  const Type* type = literals ? a_.type_table().any_real() : nullptr;
  for (ValuePtr& each : values) {
    each = e_.conversions().bits().counted(std::move(each));
    if (!each->type->is_number()) {
      wrong_operand(call, *each->type, e_.conversions().bits().bits_hint(*each->type));
      return false;
    }
    if (literals) {
      each = e_.conversions().convert(std::move(each), type, call.where);
    } else if (!each->type->is_literal()) {
      each = e_.conversions().as_real(std::move(each));
    }
  }
  if (literals) return true;
  if (unify(values, 0, call.where) == nullptr) return false;
  for (ValuePtr& each : values) each = e_.conversions().as_real(std::move(each));
  return true;
}

ValuePtr StandardAnalyzer::real_function(const Expression& call, Values values, int which) {
  if (!as_reals(call, values)) return nullptr;
  const Type* type = values[0]->type;
  const Position where = values[0]->where;
  ValuePtr result = make_standard(static_cast<StandardFunction>(which), type, std::move(values), call.where);
  return e_.operators().defined(std::move(result), where);
}

ValuePtr StandardAnalyzer::power(const Expression& call, Values values, int) {
  return e_.operators().power(std::move(values[0]), std::move(values[1]), call.where);
}

// The type of the result is that of the place where the call stands (tables 22 and 23), DINT if that says
// nothing.
ValuePtr StandardAnalyzer::truncate(const Expression& call, Values values, int) {
  const bool constant = values[0]->kind == ValueKind::Constant;
  ValuePtr result = e_.explicit_conversions().truncated(
      std::move(values[0]), a_.type_table().elementary(ElementaryType::Lint), call);
  if (!result) return nullptr;
  if (constant && result->kind == ValueKind::Constant) {
    result->type = a_.type_table().any_integer();
  } else {
    result->type = a_.type_table().elementary(ElementaryType::Dint);
    result->adapts = true;
  }
  return result;
}

ValuePtr StandardAnalyzer::is_valid(const Expression& call, Values values, int) {
  values[0] = e_.conversions().settle(std::move(values[0]));
  if (!values[0]) return nullptr;
  if (!values[0]->type->is_real()) return wrong_operand(call, *values[0]->type, "it tells NaN and infinity");
  return make_standard(StandardFunction::IsValid, a_.type_table().boolean(), std::move(values), call.where);
}

}  // namespace stepwright::semantics::internal
