// Operators on times and dates (IEC 61131-3, 6.6.2.5.12, table 35).

#include <utility>

#include "ladder/semantics/conversions/operators.h"

namespace stepwright::semantics::internal {

using syntax::Operator;

namespace {

using enum ElementaryType;

struct Row {
  Operator op;
  ElementaryType left;
  ElementaryType right;
  ElementaryType result;
};

constexpr Row kRows[] = {
    {Operator::Add, Time, Time, Time},      {Operator::Add, Tod, Time, Tod},
    {Operator::Add, Dt, Time, Dt},          {Operator::Subtract, Time, Time, Time},
    {Operator::Subtract, Date, Date, Time}, {Operator::Subtract, Tod, Time, Tod},
    {Operator::Subtract, Tod, Tod, Time},   {Operator::Subtract, Dt, Time, Dt},
    {Operator::Subtract, Dt, Dt, Time},
};

}  // namespace

ValuePtr Operators::combine_time(Operator op, ValuePtr left, ValuePtr right, Position where) {
  if (op == Operator::Multiply && right->type->is_time()) std::swap(left, right);
  right = c_.bits().counted(std::move(right));
  const bool scales = (op == Operator::Multiply || op == Operator::Divide) && left->type->is_time() &&
                      right->type->is_number();
  if (scales) return scale_time(op, std::move(left), std::move(right), where);
  const TypeTable& types = a_.type_table();
  for (const Row& row : kRows) {
    if (row.op != op || !left->type->is(row.left) || !right->type->is(row.right)) continue;
    const Type* result = types.elementary(row.result);
    ValuePtr value;
    if (left->kind == ValueKind::Constant && right->kind == ValueKind::Constant) {
      value = make_constant(*evaluate(op, left->constant, right->constant, *result), result, where);
    } else {
      value = make(ValueKind::Binary, result, where);
      value->op = op;
      value->operands.push_back(std::move(left));
      value->operands.push_back(std::move(right));
    }
    // The clock goes round: TOD#23:00:00 + T#2h is TOD#01:00:00.
    return row.result == Tod ? within_day(std::move(value)) : std::move(value);
  }
  return bad_operands(op, *left, *right, where);
}

// TIME * number, number * TIME, TIME / number. With a real in LREAL, rounded.
ValuePtr Operators::scale_time(Operator op, ValuePtr left, ValuePtr right, Position where) {
  const TypeTable& types = a_.type_table();
  const Type* time = types.elementary(Time);
  const bool with_real = right->type->is_real();
  const Type* factor = types.elementary(with_real ? Lreal : Lint);
  right = c_.convert(std::move(right), factor, where);
  if (!right) return nullptr;
  if (op == Operator::Divide && !with_real && right->kind == ValueKind::Constant &&
      right->constant.integer == 0) {
    a_.error(code::kConstantDivision, right->where, "division by zero");
    return nullptr;
  }
  const bool constant = left->kind == ValueKind::Constant && right->kind == ValueKind::Constant;
  if (constant && !with_real) {
    if (const auto folded = evaluate(op, left->constant, right->constant, *time))
      return make_constant(*folded, time, where);
  }
  if (with_real) {
    ValuePtr scaled = combine(op, convert_exactly(std::move(left), factor), std::move(right), where);
    scaled = scaled ? convert_exactly(std::move(scaled), time) : nullptr;
    if (scaled) scaled->converts_part = true;
    return scaled;
  }
  ValuePtr result = make(ValueKind::Binary, time, where);
  result->op = op;
  result->operands.push_back(std::move(left));
  result->operands.push_back(std::move(right));
  return result;
}

ValuePtr Operators::within_day(ValuePtr value) {
  const Type* type = value->type;
  const Position where = value->where;
  std::vector<ValuePtr> operands;
  operands.push_back(std::move(value));
  return make_standard(StandardFunction::TimeOfDay, type, std::move(operands), where);
}

}  // namespace stepwright::semantics::internal
