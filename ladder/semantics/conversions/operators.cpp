// Operators (IEC 61131-3, 7.3.2, table 71): operand types, the type of the result, folding of constants.

#include "ladder/semantics/conversions/operators.h"

#include <algorithm>
#include <utility>

#include "ladder/semantics/constants/common_type.h"
#include "ladder/semantics/conversions/text.h"
#include "ladder/semantics/types/operator_group.h"

namespace stepwright::semantics::internal {

using syntax::Operator;

namespace {

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

ValuePtr Operators::invert(ValuePtr operand, Position where) {
  return unary(Operator::Not, std::move(operand), where);
}

ValuePtr Operators::unary(Operator op, ValuePtr operand, Position where) {
  if (!operand) return nullptr;
  const bool is_not = op == Operator::Not;
  if (is_not) operand = c_.bits().as_bits(std::move(operand));
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

// The narrowest type that holds every value of both.
const Type* Operators::common_type(const Value& left, const Value& right) const {
  const Type& l = c_.bits().type_beside(left, right);
  const Type& r = c_.bits().type_beside(right, left);
  if (&l == &r) return &l;
  if (c_.adapts_to(left, r) && r.is_real()) return &r;
  if (c_.adapts_to(right, l) && l.is_real()) return &l;
  if (l.kind == TypeKind::AnyEnumerator || l.kind == TypeKind::Null) return takes_name(r, l) ? &r : nullptr;
  if (r.kind == TypeKind::AnyEnumerator || r.kind == TypeKind::Null) return takes_name(l, r) ? &l : nullptr;
  if (l.is_string() || r.is_string()) return common_text(left, right);
  return semantics::common_type(a_.type_table(), {l, left.constant}, {r, right.constant});
}

bool Operators::operator_applies(Operator op, const Type& type) const {
  if (!type.is_scalar() || type.kind == TypeKind::Null || type.kind == TypeKind::AnyEnumerator) return false;
  if (op == Operator::Equal || op == Operator::NotEqual) return true;
  if (is_short_circuit(op)) return type.is_bool();
  if (is_comparison(op)) return type.kind == TypeKind::Elementary || type.is_literal();
  if (is_logic(op)) return type.is_bool() || type.is_bits();
  if (op == Operator::Modulo) return type.is_integer();
  if (op == Operator::Power) return false;
  return type.is_number();
}

ValuePtr Operators::bad_operands(Operator op, const Value& left, const Value& right, Position where) {
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
    if (c_.bits().works_on_bits(op, *left.type, *right.type))
      hint = source::with_dialects(std::move(hint), &source::Dialect::bits_calculate);
  } else if (left.type->is_bits() || right.type->is_bits()) {
    const bool scales = left.type->is_time() && (op == Operator::Multiply || op == Operator::Divide);
    const bool numbers = (left.type->is_number() || left.type->is_bits() || scales) &&
                         (right.type->is_number() || right.type->is_bits());
    hint = "bit strings do not calculate; convert them to an integer first";
    if (numbers) hint = c_.bits().bits_hint(left.type->is_bits() ? *left.type : *right.type, std::move(hint));
  } else if (left.type->is_number() && right.type->is_number()) {
    hint = "no type holds both; convert one of them";
  }
  a_.error(code::kBadOperand, where,
           std::string(to_string(op)) + " cannot be applied to " + plain_name(*left.type) + " and " +
               plain_name(*right.type),
           std::move(hint));
  return nullptr;
}

ValuePtr Operators::combine(Operator op, ValuePtr left, ValuePtr right, Position where) {
  if (!left || !right) return nullptr;
  if (op == Operator::Power) return power(std::move(left), std::move(right), where);
  if (!is_comparison(op) && (is_time_or_date(*left->type) || is_time_or_date(*right->type)))
    return combine_time(op, std::move(left), std::move(right), where);
  if (a_.dialect->bits_calculate && c_.bits().works_on_bits(op, *left->type, *right->type))
    return combine_bits(op, std::move(left), std::move(right), where);
  left = c_.null_beside(std::move(left), *right);
  right = c_.null_beside(std::move(right), *left);
  const Type* common = common_type(*left, *right);
  if (common != nullptr && common->is_string() && is_comparison(op))
    return compare_texts(op, std::move(left), std::move(right), where);
  if (common == nullptr || !operator_applies(op, *common)) return bad_operands(op, *left, *right, where);
  if (common->is_literal()) {
    // SEL(b, 1, 2) has no type of its own either, yet is no constant.
    const bool constant = left->kind == ValueKind::Constant && right->kind == ValueKind::Constant;
    if (!constant) return combine(op, c_.settle(std::move(left)), c_.settle(std::move(right)), where);
    if (common->kind == TypeKind::AnyInteger) return fold_literals(op, *left, *right, where);
  }
  // A power of an integer stays one that can be a REAL beside a literal and another one.
  const auto may_be_real = [](const Value& each) {
    return each.type->is_literal() || (each.adapts && each.type->is(ElementaryType::Lreal));
  };
  const bool adapts = common->is(ElementaryType::Lreal) && may_be_real(*left) && may_be_real(*right);
  left = c_.convert(std::move(left), common, where);
  right = c_.convert(std::move(right), common, where);
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
ValuePtr Operators::fold_literals(Operator op, const Value& left, const Value& right, Position where) {
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

// What is calculated is a bit string of the larger width, whose bits are those of signed arithmetic as well.
ValuePtr Operators::combine_bits(Operator op, ValuePtr left, ValuePtr right, Position where) {
  const std::uint32_t size = std::max(c_.bits().whole_size(*left), c_.bits().whole_size(*right));
  for (ValuePtr* each : {&left, &right}) {
    if ((*each)->type->is_literal()) continue;
    if (is_logic(op)) {
      *each = c_.bits().as_bits(std::move(*each), size);
    } else {
      *each = convert_exactly(c_.bits().counted(std::move(*each)), c_.bits().whole_type(size, false));
    }
  }
  ValuePtr result = combine(op, std::move(left), std::move(right), where);
  return result && is_arithmetic(op) ? convert_exactly(std::move(result), c_.bits().whole_type(size, true))
                                     : std::move(result);
}

ValuePtr Operators::compare_texts(Operator op, ValuePtr left, ValuePtr right, Position where) {
  const Type* text = common_text(*left, *right);
  const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
  std::vector<ValuePtr> operands;
  operands.push_back(c_.convert(std::move(left), text, where));
  operands.push_back(c_.convert(std::move(right), text, where));
  ValuePtr order = text_operation(bytecode::StringOpId::CompareS, dint, std::move(operands), where);
  return combine(op, std::move(order), make_constant({}, dint, where), where);
}

// REAL ** number is REAL, all else is computed as LREAL: an integer power is exact up to 2^53. An integer
// that is implicitly a REAL makes a REAL power where one stands (figure 12).
ValuePtr Operators::power(ValuePtr base, ValuePtr exponent, Position where) {
  base = c_.bits().counted(std::move(base));
  exponent = c_.bits().counted(std::move(exponent));
  const Type& b = *base->type;
  const Type& e = *exponent->type;
  if (!b.is_number() || !e.is_number()) return bad_operands(Operator::Power, *base, *exponent, where);
  const TypeTable& types = a_.type_table();
  const bool literals = b.is_literal() && e.is_literal() && base->kind == ValueKind::Constant &&
                        exponent->kind == ValueKind::Constant;
  const bool single =
      (b.is(ElementaryType::Real) || b.kind == TypeKind::AnyReal) && !e.is(ElementaryType::Lreal);
  const Type* type =
      literals ? types.any_real() : types.elementary(single ? ElementaryType::Real : ElementaryType::Lreal);
  const Type& real = *types.elementary(ElementaryType::Real);
  const bool adapts = !literals && !single && b.is_integer() && (b.is_literal() || widens(b, real)) &&
                      !e.is(ElementaryType::Lreal);
  std::vector<ValuePtr> operands;
  operands.push_back(std::move(base));
  operands.push_back(std::move(exponent));
  for (ValuePtr& each : operands) {
    each = each->type->is_literal() ? c_.convert(std::move(each), type, where)
                                    : convert_exactly(std::move(each), type);
    if (!each) return nullptr;
  }
  ValuePtr result = defined(make_standard(StandardFunction::Power, type, std::move(operands), where), where);
  if (result) result->adapts = adapts;
  return result;
}

// A function of literals that has no value was not folded.
ValuePtr Operators::defined(ValuePtr result, Position where) {
  if (!result->type->is_literal() || result->kind == ValueKind::Constant) return result;
  a_.error(code::kOutOfRange, where, "the function is not defined for this number");
  return nullptr;
}

}  // namespace stepwright::semantics::internal
