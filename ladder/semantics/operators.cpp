// Operators (IEC 61131-3, 7.3.2, table 71): operand types, the type of the result, folding of constants.

#include <utility>

#include "ladder/semantics/common_type.h"
#include "ladder/semantics/internal/expression_analyzer.h"

namespace stepwright::semantics::internal {

using syntax::Expression;
using syntax::Operator;

namespace {

bool is_comparison(Operator op) {
  return op >= Operator::Equal && op <= Operator::GreaterEqual;
}

bool is_logic(Operator op) {
  return op == Operator::And || op == Operator::Or || op == Operator::Xor || op == Operator::AndThen ||
         op == Operator::OrElse;
}

bool is_short_circuit(Operator op) {
  return op == Operator::AndThen || op == Operator::OrElse;
}

// A reference or an enumeration beside NULL or the name of one of several enumerations.
bool takes_name(const Type& type, const Type& name) {
  return name.kind == TypeKind::Null ? type.is_reference() : type.kind == TypeKind::Enumeration;
}

bool is_time_or_date(const Type& type) {
  return type.is_time() || type.is(ElementaryType::Date) || type.is(ElementaryType::Tod) ||
         type.is(ElementaryType::Dt);
}

// A literal beyond every integer type.
bool beyond_64_bits(__int128 value) {
  const __int128 one = 1;
  return value > (one << 64) - 1 || value < -(one << 63);
}

}  // namespace

ValuePtr ExpressionAnalyzer::unary(const Expression& expression) {
  return unary(expression.op, value(*expression.operands[0]), expression.where);
}

ValuePtr ExpressionAnalyzer::invert(ValuePtr operand, Position where) {
  return unary(Operator::Not, std::move(operand), where);
}

ValuePtr ExpressionAnalyzer::unary(Operator op, ValuePtr operand, Position where) {
  if (!operand) return nullptr;
  const bool is_not = op == Operator::Not;
  if (is_not) operand = as_bits(std::move(operand));
  const Type& type = *operand->type;
  const bool negatable = type.is_number() || type.is_time();
  if (is_not ? !(type.is_bool() || type.is_bits()) : !(negatable && !type.is_unsigned())) {
    a_.error(code::kBadOperand, where, std::string(to_string(op)) + " cannot be applied to " + type.name,
             is_not && type.kind == TypeKind::Elementary && type.is_integer()
                 ? source::with_dialects("convert it to a bit string first", &source::Dialect::bits_calculate)
             : type.is_unsigned() ? "convert it to a signed type first"
                                  : "");
    return nullptr;
  }
  if (op == Operator::Plus) return operand;
  if (operand->kind == ValueKind::Constant) {
    Constant constant = operand->constant;
    if (is_not) {
      constant.integer = ~constant.integer;
    } else {
      constant = {-constant.integer, -constant.real};
    }
    return make_constant(wrapped(constant, type), &type, where);
  }
  ValuePtr result = make(ValueKind::Unary, &type, where);
  result->op = op;
  result->constant = operand->constant;
  result->operands.push_back(std::move(operand));
  return result;
}

ValuePtr ExpressionAnalyzer::binary(const Expression& expression) {
  ValuePtr result = value(*expression.operands[0]);
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    // The others are analysed even after a mistake: each may have its own.
    ValuePtr right = value(*expression.operands[i]);
    result = result && right ? combine(expression.op, std::move(result), std::move(right), expression.where)
                             : nullptr;
  }
  return result;
}

// The narrowest type that holds every value of both.
const Type* ExpressionAnalyzer::common_type(const Value& left, const Value& right) const {
  const Type& l = type_beside(left, right);
  const Type& r = type_beside(right, left);
  if (&l == &r) return &l;
  if (adapts_to(left, r) && r.is_real()) return &r;
  if (adapts_to(right, l) && l.is_real()) return &l;
  if (l.kind == TypeKind::AnyEnumerator || l.kind == TypeKind::Null) return takes_name(r, l) ? &r : nullptr;
  if (r.kind == TypeKind::AnyEnumerator || r.kind == TypeKind::Null) return takes_name(l, r) ? &l : nullptr;
  if (l.is_string() || r.is_string()) return common_text(left, right);
  return semantics::common_type(a_.type_table(), {l, left.constant}, {r, right.constant});
}

bool ExpressionAnalyzer::operator_applies(Operator op, const Type& type) const {
  if (!type.is_scalar() || type.kind == TypeKind::Null || type.kind == TypeKind::AnyEnumerator) return false;
  if (op == Operator::Equal || op == Operator::NotEqual) return true;
  if (is_short_circuit(op)) return type.is_bool();
  if (is_comparison(op)) return type.kind == TypeKind::Elementary || type.is_literal();
  if (is_logic(op)) return type.is_bool() || type.is_bits();
  if (op == Operator::Modulo) return type.is_integer();
  if (op == Operator::Power) return false;
  return type.is_number();
}

ValuePtr ExpressionAnalyzer::bad_operands(Operator op, const Value& left, const Value& right,
                                          Position where) {
  if (is_logic(op) && left.type->is_bool() != right.type->is_bool()) {
    const Value& wrong = left.type->is_bool() ? right : left;
    a_.error(code::kTypeMismatch, wrong.where, "expected BOOL, found " + wrong.type->name,
             wrong.type->is_number() ? "compare it, for instance with '<> 0'" : "");
    return nullptr;
  }
  std::string hint;
  if (left.type->is_string() || right.type->is_string()) {
    if (op == Operator::Add) hint = "strings are joined with CONCAT(...)";
  } else if (is_logic(op) && (left.type->is_number() || right.type->is_number())) {
    hint = "logic works on BOOL and bit strings; compare, or convert with " +
           (left.type->is_literal() ? std::string("INT") : left.type->name) + "_TO_WORD";
    if (works_on_bits(op, *left.type, *right.type))
      hint = source::with_dialects(std::move(hint), &source::Dialect::bits_calculate);
  } else if (left.type->is_bits() || right.type->is_bits()) {
    const bool scales = left.type->is_time() && (op == Operator::Multiply || op == Operator::Divide);
    const bool numbers = (left.type->is_number() || left.type->is_bits() || scales) &&
                         (right.type->is_number() || right.type->is_bits());
    hint = "bit strings do not calculate; convert them to an integer first";
    if (numbers) hint = bits_hint(left.type->is_bits() ? *left.type : *right.type, std::move(hint));
  } else if (left.type->is_number() && right.type->is_number()) {
    hint = "no type holds both; convert one of them";
  }
  a_.error(code::kBadOperand, where,
           std::string(to_string(op)) + " cannot be applied to " + plain_name(*left.type) + " and " +
               plain_name(*right.type),
           std::move(hint));
  return nullptr;
}

ValuePtr ExpressionAnalyzer::combine(Operator op, ValuePtr left, ValuePtr right, Position where) {
  if (!left || !right) return nullptr;
  if (op == Operator::Power) return power(std::move(left), std::move(right), where);
  if (!is_comparison(op) && (is_time_or_date(*left->type) || is_time_or_date(*right->type)))
    return combine_time(op, std::move(left), std::move(right), where);
  if (a_.dialect->bits_calculate && works_on_bits(op, *left->type, *right->type))
    return combine_bits(op, std::move(left), std::move(right), where);
  left = null_beside(std::move(left), *right);
  right = null_beside(std::move(right), *left);
  const Type* common = common_type(*left, *right);
  if (common != nullptr && common->is_string() && is_comparison(op))
    return compare_texts(op, std::move(left), std::move(right), where);
  if (common == nullptr || !operator_applies(op, *common)) return bad_operands(op, *left, *right, where);
  if (common->is_literal()) {
    // SEL(b, 1, 2) has no type of its own either, yet is no constant.
    const bool constant = left->kind == ValueKind::Constant && right->kind == ValueKind::Constant;
    if (!constant) return combine(op, settle(std::move(left)), settle(std::move(right)), where);
    if (common->kind == TypeKind::AnyInteger) return fold_literals(op, *left, *right, where);
  }
  // A power of an integer stays one that can be a REAL beside a literal and another one.
  const auto may_be_real = [](const Value& each) {
    return each.type->is_literal() || (each.adapts && each.type->is(ElementaryType::Lreal));
  };
  const bool adapts = common->is(ElementaryType::Lreal) && may_be_real(*left) && may_be_real(*right);
  left = convert(std::move(left), common, where);
  right = convert(std::move(right), common, where);
  if (!left || !right) return nullptr;
  const bool divides = op == Operator::Divide || op == Operator::Modulo;
  if (divides && right->kind == ValueKind::Constant && right->constant.integer == 0 &&
      right->constant.real == 0) {
    a_.error(code::kConstantDivision, right->where, "division by zero");
    return nullptr;
  }
  const Type* type = is_comparison(op) ? a_.type_table().boolean() : common;
  if (left->kind == ValueKind::Constant && right->kind == ValueKind::Constant) {
    if (const auto folded = evaluate(op, left->constant, right->constant, *common))
      return make_constant(*folded, type, where);
  }
  // A chain stays flat while its type stays the same.
  if (left->kind == ValueKind::Binary && left->op == op && !is_comparison(op) && left->type == common &&
      left->operands[0]->type == common) {
    left->operands.push_back(std::move(right));
    left->adapts = adapts;
    return left;
  }
  ValuePtr result = make(ValueKind::Binary, type, where);
  result->op = op;
  result->adapts = adapts && type == common;
  result->operands.push_back(std::move(left));
  result->operands.push_back(std::move(right));
  return result;
}

// Literals are computed without a type: 1000 * 1000 is 1000000, whatever it is assigned to.
ValuePtr ExpressionAnalyzer::fold_literals(Operator op, const Value& left, const Value& right,
                                           Position where) {
  const Constant& l = left.constant;
  const Constant& r = right.constant;
  if ((op == Operator::Divide || op == Operator::Modulo) && r.integer == 0) {
    a_.error(code::kConstantDivision, right.where, "division by zero");
    return nullptr;
  }
  __int128 product = 0;
  const bool overflows = op == Operator::Multiply && __builtin_mul_overflow(l.integer, r.integer, &product);
  const auto folded = overflows ? std::nullopt : evaluate(op, l, r, *left.type);
  if (!folded || beyond_64_bits(folded->integer)) {
    a_.error(code::kLiteralRange, where, "the constant is larger than 64 bits");
    return nullptr;
  }
  const Type* type = is_comparison(op) ? a_.type_table().boolean() : left.type;
  return make_constant(*folded, type, where);
}

}  // namespace stepwright::semantics::internal
