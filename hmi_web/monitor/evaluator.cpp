#include "hmi_web/monitor/evaluator.h"

#include "ladder/semantics/constants/common_type.h"
#include "ladder/semantics/constants/constant_conversion.h"
#include "ladder/semantics/types/operator_group.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::monitor {

using bytecode::ElementaryType;
using semantics::is_and;
using semantics::is_comparison;
using semantics::is_logic;
using semantics::is_or;
using semantics::Type;
using syntax::Expression;
using syntax::ExpressionKind;
using syntax::Operator;

namespace {

bool applies(Operator op, const Type& type) {
  if (is_comparison(op)) return true;
  if (is_logic(op)) return type.is_bool() || type.is_bits();
  return op == Operator::Modulo ? type.is_integer() : type.is_number();
}

}  // namespace

Value Evaluator::value(const Expression& expression) const {
  switch (expression.kind) {
    case ExpressionKind::Boolean:
      return boolean(expression.integer != 0);
    case ExpressionKind::Integer:
      return number(expression, types_.any_integer());
    case ExpressionKind::Real:
      return number(expression, types_.any_real());
    case ExpressionKind::Time:
      return literal(expression, ElementaryType::Time);
    case ExpressionKind::Date:
      return literal(expression, ElementaryType::Date);
    case ExpressionKind::TimeOfDay:
      return literal(expression, ElementaryType::Tod);
    case ExpressionKind::DateAndTime:
      return literal(expression, ElementaryType::Dt);
    case ExpressionKind::Variable:
    case ExpressionKind::Direct:
    case ExpressionKind::Field:
    case ExpressionKind::Index: {
      const auto name = path(expression);
      return name ? lookup_(*name) : std::nullopt;
    }
    case ExpressionKind::Unary:
      return unary(expression.op, value(*expression.operands[0]));
    case ExpressionKind::Binary: {
      Value result = value(*expression.operands[0]);
      for (std::size_t i = 1; i < expression.operands.size(); ++i)
        result = combine(expression.op, result, value(*expression.operands[i]));
      return result;
    }
    case ExpressionKind::Call: {
      if (!expression.operands.empty() || expression.enable) return std::nullopt;
      std::vector<Value> inputs;
      for (const syntax::Argument& each : expression.arguments)
        if (!each.is_output) inputs.push_back(value(each.value.get()));
      return call(expression.name.text, inputs);
    }
    default:
      return std::nullopt;
  }
}

Value Evaluator::literal(const Expression& expression, ElementaryType type) const {
  return Known{types_.elementary(type), {expression.time_ns}};
}

Value Evaluator::number(const Expression& expression, const Type* otherwise) const {
  const bool real = expression.kind == ExpressionKind::Real;
  const Known plain{otherwise, real ? semantics::Constant{0, expression.real}
                                    : semantics::Constant{static_cast<__int128>(expression.integer)}};
  ElementaryType type{};
  if (!expression.prefix) return plain;
  if (!semantics::elementary_from(naming::upper(expression.prefix->text), type)) return std::nullopt;
  return to_type(plain, types_.elementary(type));
}

std::optional<std::string> Evaluator::path(const Expression& expression) const {
  switch (expression.kind) {
    case ExpressionKind::Variable:
      return std::string(expression.name.text);
    case ExpressionKind::Direct:
      if (expression.address.byte >= syntax::kHierarchical) return std::nullopt;
      return syntax::to_string(expression.address);
    case ExpressionKind::Field: {
      auto path_of = path(*expression.operands[0]);
      if (path_of) *path_of += '.' + std::string(expression.name.text);
      return path_of;
    }
    case ExpressionKind::Index: {
      auto path_of = path(*expression.operands[0]);
      for (std::size_t i = 1; path_of && i < expression.operands.size(); ++i) {
        const Value index = value(*expression.operands[i]);
        if (!index || !index->type->is_integer()) return std::nullopt;
        *path_of += '[' + semantics::to_string(index->constant.integer) + ']';
      }
      return path_of;
    }
    default:
      return std::nullopt;
  }
}

Value Evaluator::to_type(const Known& value, const Type* type) const {
  if (value.type == type) return value;
  auto constant = semantics::converted(value.constant, *value.type, *type);
  return constant ? Value(Known{type, std::move(*constant)}) : std::nullopt;
}

Value Evaluator::unary(Operator op, const Value& operand) const {
  if (op == Operator::Not) return invert(operand);
  if (!operand || !(operand->type->is_number() || operand->type->is_time())) return std::nullopt;
  if (op == Operator::Plus) return operand;
  const semantics::Constant negative{-operand->constant.integer, -operand->constant.real};
  return Known{operand->type, semantics::wrapped(negative, *operand->type)};
}

Value Evaluator::invert(const Value& value) const {
  if (!value || !(value->type->is_bool() || value->type->is_bits())) return std::nullopt;
  return Known{value->type, semantics::wrapped({~value->constant.integer}, *value->type)};
}

// Of BOOL, one of which may not be known.
Value Evaluator::logic(Operator op, const Value& left, const Value& right) const {
  if (is_and(op) ? is_false(left) || is_false(right) : is_true(left) || is_true(right))
    return boolean(!is_and(op));
  if (!left || !right) return std::nullopt;
  return boolean(is_and(op));
}

Value Evaluator::combine(Operator op, const Value& left, const Value& right) const {
  const bool of_bools = (!left || is_bool(left)) && (!right || is_bool(right));
  if (of_bools && (is_and(op) || is_or(op))) return logic(op, left, right);
  if (!left || !right) return std::nullopt;
  if (op == Operator::Power) return power(*left, *right);
  if (!is_comparison(op) && (left->type->is_time() || right->type->is_time()))
    return duration(op, *left, *right);
  const Type* common =
      semantics::common_type(types_, {*left->type, left->constant}, {*right->type, right->constant});
  if (common == nullptr || !applies(op, *common)) return std::nullopt;
  const Value l = to_type(*left, common);
  const Value r = to_type(*right, common);
  if (!l || !r) return std::nullopt;
  auto result = semantics::evaluate(op, l->constant, r->constant, *common);
  if (!result) return std::nullopt;
  return Known{is_comparison(op) ? types_.boolean() : common, std::move(*result)};
}

Value Evaluator::power(const Known& base, const Known& exponent) const {
  const Type* type = types_.elementary(ElementaryType::Lreal);
  if (!base.type->is_number() || !exponent.type->is_number()) return std::nullopt;
  const Value l = to_type(base, type);
  const Value r = to_type(exponent, type);
  if (!l || !r) return std::nullopt;
  const semantics::Constant operands[] = {l->constant, r->constant};
  auto result = semantics::evaluate(semantics::StandardFunction::Power, operands, *type, *type);
  return result ? Value(Known{type, std::move(*result)}) : std::nullopt;
}

// A duration with another one, or as many times as a whole number says.
Value Evaluator::duration(Operator op, const Known& left, const Known& right) const {
  const bool sums = op == Operator::Add || op == Operator::Subtract;
  const bool scales = op == Operator::Multiply || op == Operator::Divide;
  const bool fits = sums     ? left.type->is_time() && right.type->is_time()
                    : scales ? left.type->is_time() && right.type->is_integer()
                             : false;
  if (!fits) return std::nullopt;
  auto result = semantics::evaluate(op, left.constant, right.constant, *left.type);
  return result ? Value(Known{left.type, std::move(*result)}) : std::nullopt;
}

}  // namespace stepwright::monitor
