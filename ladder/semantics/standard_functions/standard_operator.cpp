// Operators as functions (IEC 61131-3, 6.6.2.5.7 and 6.6.2.5.9, tables 29 to 33).

#include <algorithm>
#include <utility>

#include "ladder/semantics/standard_functions/standard_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::Operator;

namespace {

constexpr int id(Operator op) {
  return static_cast<int>(op);
}

constexpr std::size_t kAll = 1000;

}  // namespace

std::span<const StandardAnalyzer::Entry> StandardAnalyzer::operator_entries() {
  using S = StandardAnalyzer;
  static constexpr Entry kEntries[] = {
      {"ADD", "IN1 IN2+", 2, &S::operate, id(Operator::Add), 0, kAll},
      {"SUB", "IN1 IN2", 2, &S::operate, id(Operator::Subtract), 0, 2},
      {"MUL", "IN1 IN2+", 2, &S::operate, id(Operator::Multiply), 0, kAll},
      {"DIV", "IN1 IN2", 2, &S::operate, id(Operator::Divide), 0, 2},
      {"MOD", "IN1 IN2", 2, &S::operate, id(Operator::Modulo), 0, 2},
      {"AND", "IN1 IN2+", 2, &S::operate, id(Operator::And), 0, kAll},
      {"OR", "IN1 IN2+", 2, &S::operate, id(Operator::Or), 0, kAll},
      {"XOR", "IN1 IN2+", 2, &S::operate, id(Operator::Xor), 0, kAll},
      {"NOT", "IN", 1, &S::invert, 0, 0, 1},
      {"EQ", "IN1 IN2+", 2, &S::compare, id(Operator::Equal), 0, kAll},
      {"NE", "IN1 IN2", 2, &S::compare, id(Operator::NotEqual), 0, 2},
      {"LT", "IN1 IN2+", 2, &S::compare, id(Operator::Less), 0, kAll},
      {"LE", "IN1 IN2+", 2, &S::compare, id(Operator::LessEqual), 0, kAll},
      {"GT", "IN1 IN2+", 2, &S::compare, id(Operator::Greater), 0, kAll},
      {"GE", "IN1 IN2+", 2, &S::compare, id(Operator::GreaterEqual), 0, kAll},
      {"MOVE", "IN", 1, &S::move, 0, 0, 1},
  };
  return kEntries;
}

ValuePtr StandardAnalyzer::operate(const Expression& call, Values values, int which) {
  ValuePtr result = std::move(values[0]);
  for (std::size_t i = 1; i < values.size() && result; ++i)
    result = e_.operators().combine(static_cast<Operator>(which), std::move(result), std::move(values[i]),
                                    call.where);
  return result;
}

ValuePtr StandardAnalyzer::invert(const Expression& call, Values values, int) {
  return e_.operators().invert(std::move(values[0]), call.where);
}

ValuePtr StandardAnalyzer::move(const Expression&, Values values, int) {
  return std::move(values[0]);
}

// GT(a, b, c) is (a > b) AND (b > c), each argument evaluated once.
ValuePtr StandardAnalyzer::compare(const Expression& call, Values values, int which) {
  const auto op = static_cast<Operator>(which);
  if (values.size() == 2)
    return e_.operators().combine(op, std::move(values[0]), std::move(values[1]), call.where);
  const Type* type = unify(values, 0, call.where);
  if (type == nullptr) return nullptr;
  if (type->is_literal()) {
    for (ValuePtr& each : values) each = e_.conversions().settle(std::move(each));
    type = unify(values, 0, call.where);
    if (type == nullptr) return nullptr;
  }
  if (!type->is_string() && !e_.operators().operator_applies(op, *type)) return wrong_operand(call, *type);
  ValuePtr result = make(ValueKind::Chain, a_.type_table().boolean(), call.where);
  result->op = op;
  result->operands = std::move(values);
  return result;
}

}  // namespace stepwright::semantics::internal
