// Functions of times and dates with types in their names (IEC 61131-3, 6.6.2.5.12, table 35).

#include <utility>

#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::Operator;

namespace {

using enum ElementaryType;

// Operator and operand types in one number; Bool stands for ANY_NUM.
constexpr int operation(Operator op, ElementaryType left, ElementaryType right) {
  return static_cast<int>(op) << 16 | static_cast<int>(left) << 8 | static_cast<int>(right);
}

}  // namespace

std::span<const StandardAnalyzer::Entry> StandardAnalyzer::time_entries() {
  using S = StandardAnalyzer;
  constexpr auto kAdd = Operator::Add;
  constexpr auto kSub = Operator::Subtract;
  constexpr auto kMul = Operator::Multiply;
  constexpr auto kDiv = Operator::Divide;
  constexpr std::string_view kTwo = "IN1 IN2";
  static constexpr Entry kEntries[] = {
      {"ADD_TIME", kTwo, 2, &S::time_operation, operation(kAdd, Time, Time)},
      {"ADD_LTIME", kTwo, 2, &S::time_operation, operation(kAdd, Time, Time)},
      {"ADD_TOD_TIME", kTwo, 2, &S::time_operation, operation(kAdd, Tod, Time)},
      {"ADD_LTOD_LTIME", kTwo, 2, &S::time_operation, operation(kAdd, Tod, Time)},
      {"ADD_DT_TIME", kTwo, 2, &S::time_operation, operation(kAdd, Dt, Time)},
      {"ADD_LDT_LTIME", kTwo, 2, &S::time_operation, operation(kAdd, Dt, Time)},
      {"SUB_TIME", kTwo, 2, &S::time_operation, operation(kSub, Time, Time)},
      {"SUB_LTIME", kTwo, 2, &S::time_operation, operation(kSub, Time, Time)},
      {"SUB_DATE_DATE", kTwo, 2, &S::time_operation, operation(kSub, Date, Date)},
      {"SUB_LDATE_LDATE", kTwo, 2, &S::time_operation, operation(kSub, Date, Date)},
      {"SUB_TOD_TIME", kTwo, 2, &S::time_operation, operation(kSub, Tod, Time)},
      {"SUB_LTOD_LTIME", kTwo, 2, &S::time_operation, operation(kSub, Tod, Time)},
      {"SUB_TOD_TOD", kTwo, 2, &S::time_operation, operation(kSub, Tod, Tod)},
      {"SUB_LTOD_LTOD", kTwo, 2, &S::time_operation, operation(kSub, Tod, Tod)},
      {"SUB_DT_TIME", kTwo, 2, &S::time_operation, operation(kSub, Dt, Time)},
      {"SUB_LDT_LTIME", kTwo, 2, &S::time_operation, operation(kSub, Dt, Time)},
      {"SUB_DT_DT", kTwo, 2, &S::time_operation, operation(kSub, Dt, Dt)},
      {"SUB_LDT_LDT", kTwo, 2, &S::time_operation, operation(kSub, Dt, Dt)},
      {"MUL_TIME", kTwo, 2, &S::time_operation, operation(kMul, Time, Bool)},
      {"MUL_LTIME", kTwo, 2, &S::time_operation, operation(kMul, Time, Bool)},
      {"MULTIME", kTwo, 2, &S::time_operation, operation(kMul, Time, Bool)},
      {"DIV_TIME", kTwo, 2, &S::time_operation, operation(kDiv, Time, Bool)},
      {"DIV_LTIME", kTwo, 2, &S::time_operation, operation(kDiv, Time, Bool)},
      {"DIVTIME", kTwo, 2, &S::time_operation, operation(kDiv, Time, Bool)},
      // What the library is written with; no names that a user's source can hold by accident.
      {"__NOW", "", 0, &S::now},
      {"__FAIL", "", 0, &S::fail},
      // What watchers of a program stop it with.
      {"__STOP", "", 0, &S::stop},
  };
  return kEntries;
}

ValuePtr StandardAnalyzer::time_operation(const Expression& call, Values values, int which) {
  const TypeTable& types = a_.type_table();
  const auto op = static_cast<Operator>(which >> 16);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto type = static_cast<ElementaryType>(which >> (i == 0 ? 8 : 0) & 0xFF);
    const Position where = values[i]->where;
    if (type != Bool) {
      values[i] = e_.conversions().convert(std::move(values[i]), types.elementary(type), where);
      if (!values[i]) return nullptr;
    } else if (!values[i]->type->is_number()) {
      return wrong_operand(call, *values[i]->type, "the factor is a number");
    }
  }
  return e_.operators().combine(op, std::move(values[0]), std::move(values[1]), call.where);
}

ValuePtr StandardAnalyzer::now(const Expression& call, Values, int) {
  return make(ValueKind::Now, a_.type_table().elementary(Time), call.where);
}

// Stops the program: an argument of a function of the library is outside of its domain.
ValuePtr StandardAnalyzer::fail(const Expression& call, Values, int) {
  return make(ValueKind::Fail, a_.type_table().boolean(), call.where);
}

ValuePtr StandardAnalyzer::stop(const Expression& call, Values, int) {
  return make(ValueKind::Stop, a_.type_table().boolean(), call.where);
}

}  // namespace stepwright::semantics::internal
