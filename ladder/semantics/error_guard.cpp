// Errors of standard functions whose ENO is connected (IEC 61131-3, 6.6.1.5): ENO becomes FALSE, the function
// is not run, and the scan goes on. The operands are computed first, once, into slots; what they must hold is
// tested there.

#include <utility>

#include "ladder/semantics/internal/expression_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Operator;

namespace {

// A constant, or a slot: what may be read twice.
ValuePtr again(const Value& operand) {
  if (operand.kind == ValueKind::Constant)
    return ExpressionAnalyzer::make_constant(operand.constant, operand.type, operand.where);
  return ExpressionAnalyzer::load(ExpressionAnalyzer::copy_direct(operand.place), operand.where);
}

bool may_be_negative(const Value& value) {
  if (value.kind == ValueKind::Constant) return value.constant.integer < 0;
  if (value.kind == ValueKind::Convert) return may_be_negative(*value.operands.front());
  return !value.type->is_unsigned();
}

bool divides_integers(const Value& called) {
  const bool divides =
      called.kind == ValueKind::Binary && (called.op == Operator::Divide || called.op == Operator::Modulo);
  return divides && called.operands.size() == 2 && called.operands[1]->type->is_integer();
}

bool makes_integer_of_real(const Value& called) {
  const bool converts = called.kind == ValueKind::Convert || called.kind == ValueKind::Truncate;
  return converts && called.operands[0]->type->is_real() && called.type->is_integer();
}

// How many operands the test reads; 0 = no error that can be told beforehand.
std::size_t tested_operands(const Value& called) {
  using enum StandardFunction;
  if (divides_integers(called)) return 2;
  if (makes_integer_of_real(called) || called.kind == ValueKind::Multiplex) return 1;
  if (called.kind == ValueKind::Shift) return may_be_negative(*called.operands[1]) ? 2 : 0;
  if (called.kind != ValueKind::Standard) return 0;
  const StandardFunction f = called.function;
  return f == Sqrt || f == Ln || f == Log || f == Asin || f == Acos ? 1 : 0;
}

}  // namespace

// What holds where the function has a value; its operands can be read again.
ValuePtr ExpressionAnalyzer::has_value(const Value& called) {
  const Position where = called.where;
  const auto test = [&](const Value& operand, Operator op, Constant bound) {
    return combine(op, again(operand), make_constant(bound, operand.type, where), where);
  };
  const auto both = [&](ValuePtr left, ValuePtr right) {
    return combine(Operator::And, std::move(left), std::move(right), where);
  };
  const auto none = [&](ValuePtr wrong) {
    ValuePtr result = make(ValueKind::Unary, a_.type_table().boolean(), where);
    result->op = Operator::Not;
    result->operands.push_back(std::move(wrong));
    return result;
  };
  const Value& first = *called.operands[0];
  if (called.kind == ValueKind::Binary) return test(*called.operands[1], Operator::NotEqual, {0});
  if (called.kind == ValueKind::Shift) return test(*called.operands[1], Operator::GreaterEqual, {0});
  if (called.kind == ValueKind::Multiplex) {
    const auto count = static_cast<__int128>(called.operands.size() - 1);
    return both(test(first, Operator::GreaterEqual, {0}), test(first, Operator::Less, {count}));
  }
  if (called.kind == ValueKind::Convert || called.kind == ValueKind::Truncate) {
    // Rounded to the nearest, ties to even; or cut towards zero. The lower bound of a wide type has no
    // neighbour below among the reals.
    const IntegerRange range = range_of(called.type->elementary);
    const bool cuts = called.kind == ValueKind::Truncate;
    const bool is_dense = first.type->size == 8 ? called.type->size < 8 : called.type->size < 4;
    const double low = static_cast<double>(range.low);
    const double high = static_cast<double>(range.high) + (cuts ? 1.0 : 0.5);
    const Operator above = cuts && is_dense ? Operator::Greater : Operator::GreaterEqual;
    const double below = cuts ? 1.0 : 0.5;
    return both(test(first, above, {0, is_dense ? low - below : low}),
                test(first, Operator::Less, {0, high}));
  }
  // NaN is no error of these.
  if (called.function == StandardFunction::Sqrt) return none(test(first, Operator::Less, {0, 0.0}));
  if (called.function == StandardFunction::Ln || called.function == StandardFunction::Log)
    return none(test(first, Operator::LessEqual, {0, 0.0}));
  return both(none(test(first, Operator::Less, {0, -1.0})), none(test(first, Operator::Greater, {0, 1.0})));
}

ValuePtr ExpressionAnalyzer::unless_error(ValuePtr called, const Place& enabled) {
  const std::size_t tested = tested_operands(*called);
  if (tested == 0 || !called->type->is_scalar()) return called;
  ValuePtr result = make(ValueKind::Enabled, called->type, called->where);
  for (std::size_t i = 0; i < tested; ++i) {
    ValuePtr& operand = called->operands[i];
    if (operand->kind == ValueKind::Constant) continue;
    pou_->slots.push_back(slot_type(*operand->type));
    Place slot;
    slot.base = Base::Slot;
    slot.slot = static_cast<std::uint32_t>(pou_->slots.size() - 1);
    slot.type = operand->type;
    const Position where = operand->where;
    result->before.push_back({copy_direct(slot), std::move(operand)});
    operand = load(std::move(slot), where);
  }
  ValuePtr good = has_value(*called);
  if (!good) return nullptr;
  result->before.push_back({copy_direct(enabled), std::move(good)});
  result->operands.push_back(load(copy_direct(enabled), called->where));
  result->constant = first_value(*called->type);
  result->operands.push_back(std::move(called));
  return result;
}

Constant ExpressionAnalyzer::first_value(const Type& scalar) {
  std::vector<std::byte> first = scalar.initial;
  first.resize(scalar.size);
  return semantics::load(scalar, first);
}

}  // namespace stepwright::semantics::internal
