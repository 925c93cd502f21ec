// What the types of expressions show, over the semantic model.

#include <algorithm>
#include <iterator>
#include <map>

#include "ladder/lint/internal/rules.h"
#include "ladder/source/codes.h"

namespace stepwright::lint::internal {

namespace code = source::code;
using semantics::Block;
using semantics::Statement;
using semantics::StatementKind;
using semantics::Type;
using semantics::TypeKind;
using semantics::Value;
using semantics::ValueKind;
using syntax::Operator;

namespace {

class ValueWalker {
 public:
  ValueWalker(const semantics::Pou& pou, Level level, source::DiagnosticSink& sink)
      : pou_(pou), level_(level), sink_(sink) {}

  void block(const Block& list) {
    for (const Statement& each : list) statement(each);
  }

 private:
  bool speaks_of(Position where) const {
    return pou_.declaration->origin == syntax::BodyOrigin::Text || where.file == pou_.where.file;
  }

  void statement(const Statement& each) {
    place(each.target);
    for (const auto& value_of : {&each.value, &each.limit, &each.step})
      if (*value_of) value(**value_of);
    for (const auto& copy : each.before) value(*copy.value);
    for (const auto& copy : each.after) value(*copy.value);
    for (const semantics::Branch& branch : each.branches) {
      if (branch.condition) value(*branch.condition);
      block(branch.body);
    }
    block(each.body);
    if (each.kind == StatementKind::Case && each.value) check_case(each);
  }

  void place(const semantics::Place& each) {
    for (const semantics::PlaceStep& step : each.steps)
      if (step.index) value(*step.index);
  }

  void value(const Value& each) {
    for (const auto& operand : each.operands)
      if (operand) value(*operand);
    place(each.place);
    for (const auto& copy : each.before) value(*copy.value);
    if (each.kind == ValueKind::Binary && each.operands.size() == 2 && speaks_of(each.where)) compare(each);
  }

  static bool is_zero(const Value& value) {
    return value.kind == ValueKind::Constant && value.constant.real == 0 && value.constant.integer == 0;
  }

  void compare(const Value& each) {
    const Value& left = *each.operands[0];
    const Value& right = *each.operands[1];
    if (left.type == nullptr || right.type == nullptr) return;
    const bool equality = each.op == Operator::Equal || each.op == Operator::NotEqual;
    // Zero is exact: "is there a divisor" is a question that has an answer.
    if (level_ == Level::All && equality && left.type->is_real() && !is_zero(left) && !is_zero(right))
      sink_.warning(code::kRealEquality, each.where, "values of " + left.type->name + " are seldom equal",
                    "compare ABS(a - b) with what may differ");
    const bool always = each.op == Operator::GreaterEqual && is_zero(right);
    const bool never = each.op == Operator::Less && is_zero(right);
    if ((always || never) && left.type->is_unsigned() && left.kind != ValueKind::Constant)
      sink_.warning(code::kConstantCondition, each.where,
                    "a value of " + left.type->name + " is " + (always ? "always" : "never") +
                        (always ? " >= 0" : " < 0"));
  }

  // Enumerators that no label names.
  void check_case(const Statement& each) {
    const Type& type = *each.value->type;
    const bool has_else = !each.branches.empty() && each.branches.back().ranges.empty();
    if (type.kind != TypeKind::Enumeration || has_else || !speaks_of(each.where)) return;
    // Low -> high; no two labels share a value.
    std::map<__int128, __int128> labels;
    for (const semantics::Branch& branch : each.branches)
      for (const semantics::CaseRange& range : branch.ranges)
        labels.emplace(range.low.integer, range.high.integer);
    std::string missing;
    std::size_t count = 0;
    for (const semantics::Enumerator& enumerator : type.enumerators) {
      const auto next = labels.upper_bound(enumerator.value);
      if (next != labels.begin() && enumerator.value <= std::prev(next)->second) continue;
      if (++count <= 4) missing += (missing.empty() ? "" : ", ") + enumerator.spelling;
    }
    if (count == 0) return;
    if (count > 4) missing += " and " + std::to_string(count - 4) + " more";
    sink_.warning(code::kMissingCase, each.where, "this CASE leaves out " + missing,
                  "name them, or add ELSE");
  }

  const semantics::Pou& pou_;
  Level level_;
  source::DiagnosticSink& sink_;
};

}  // namespace

void check_values(const semantics::Pou& pou, Level level, source::DiagnosticSink& sink) {
  if (pou.declaration->origin != syntax::BodyOrigin::Ladder) ValueWalker(pou, level, sink).block(pou.body);
}

}  // namespace stepwright::lint::internal
