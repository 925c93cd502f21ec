#include "ladder/semantics/calls/value_condition.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "ladder/semantics/constants/constant_conversion.h"

namespace stepwright::semantics::internal {

using bytecode::StringOpId;
using syntax::Operator;

namespace {

// A constant, or a slot: what may be read twice.
ValuePtr again(const Value& operand) {
  if (operand.kind == ValueKind::Constant)
    return make_constant(operand.constant, operand.type, operand.where);
  return load(copy_direct(operand.place), operand.where);
}

// The decimal digits of a number, each in 4 bits.
__int128 as_bcd(__int128 number) {
  __int128 code = 0;
  for (int shift = 0; number > 0; shift += 4, number /= 10) code |= (number % 10) << shift;
  return code;
}

__int128 most_of_digits(unsigned digits) {
  __int128 most = 1;
  for (unsigned i = 0; i < digits; ++i) most *= 10;
  return most - 1;
}

}  // namespace

ValuePtr ValueCondition::compare(const Value& operand, Operator op, Constant bound) {
  return e_.operators().combine(op, again(operand), make_constant(bound, operand.type, operand.where),
                                operand.where);
}

ValuePtr ValueCondition::both(ValuePtr left, ValuePtr right) {
  if (!left || !right) return nullptr;
  const Position where = left->where;
  return e_.operators().combine(Operator::And, std::move(left), std::move(right), where);
}

ValuePtr ValueCondition::neither(ValuePtr wrong) {
  if (!wrong) return nullptr;
  ValuePtr result = make(ValueKind::Unary, a_.type_table().boolean(), wrong->where);
  result->op = Operator::Not;
  result->operands.push_back(std::move(wrong));
  return result;
}

ValuePtr ValueCondition::has_value(const Value& called, ErrorTest test) {
  const Value& first = *called.operands[0];
  switch (test) {
    case ErrorTest::Divisor:
      return compare(*called.operands[1], Operator::NotEqual, {0});
    case ErrorTest::Places:
      return compare(*called.operands[1], Operator::GreaterEqual, {0});
    case ErrorTest::Choice: {
      const auto count = static_cast<__int128>(called.operands.size() - 1);
      return both(compare(first, Operator::GreaterEqual, {0}), compare(first, Operator::Less, {count}));
    }
    case ErrorTest::Range:
      return is_in_range(called);
    case ErrorTest::Single:
      return fits_real(first);
    case ErrorTest::Duration:
      return is_duration(called);
    case ErrorTest::Domain:
      return is_in_domain(called);
    case ErrorTest::Power:
      return is_power(first, *called.operands[1]);
    case ErrorTest::Code:
      return is_code(first, *called.type);
    case ErrorTest::Digits:
      return has_digits(first, *called.type);
    case ErrorTest::Literal:
      return is_literal(called);
    case ErrorTest::Arguments:
      return takes_arguments(called);
    case ErrorTest::FirstCharacter: {
      const Type* dint = a_.type_table().elementary(ElementaryType::Dint);
      return e_.operators().combine(Operator::Greater,
                                    text_operation(StringOpId::LengthS, dint, again(first), first.where),
                                    make_constant({0}, dint, first.where), first.where);
    }
    case ErrorTest::Counts:
      break;
    case ErrorTest::None:
      return nullptr;
  }
  ValuePtr good;
  for (const ValuePtr& each : called.operands) {
    if (!each->type->is_integer() || each->kind == ValueKind::Constant) continue;
    ValuePtr one = compare(*each, Operator::GreaterEqual, {0});
    good = good ? both(std::move(good), std::move(one)) : std::move(one);
  }
  return good;
}

// The function of the library that tells whether another one of it has a value; null if there is none.
const Pou* ValueCondition::condition_of(const Pou& function) const {
  const auto of_library = [&](const Pou& pou) { return a_.sink.sources().is_library(pou.where.file); };
  if (!of_library(function)) return nullptr;
  const auto name = a_.names.find(std::string(kConditionPrefix) + a_.names.folded(function.name));
  const auto found = name ? a_.pous.find(name->value) : a_.pous.end();
  return found != a_.pous.end() && of_library(*found->second) ? found->second : nullptr;
}

// Rounded to the nearest, ties to even; or cut towards zero. The lower bound of a wide signed type has no
// neighbour below among the reals.
ValuePtr ValueCondition::is_in_range(const Value& called) {
  const Value& first = *called.operands[0];
  const IntegerRange range = range_of(called.type->elementary);
  const bool cuts = called.kind == ValueKind::Truncate;
  const bool is_narrow = first.type->size == 8 ? called.type->size < 8 : called.type->size < 4;
  const bool is_dense = is_narrow || range.low == 0;
  const double low = static_cast<double>(range.low);
  const double high = static_cast<double>(range.high) + (cuts ? 1.0 : 0.5);
  const Operator above = cuts && is_dense ? Operator::Greater : Operator::GreaterEqual;
  const double below = cuts ? 1.0 : 0.5;
  return both(compare(first, above, {0, is_dense ? low - below : low}),
              compare(first, Operator::Less, {0, high}));
}

// Rounds to a REAL: is below the middle of the largest one and 2**128, or infinite, or NaN.
ValuePtr ValueCondition::fits_real(const Value& number) {
  constexpr double kBeyond = 0x1.ffffffp127;
  ValuePtr held =
      both(compare(number, Operator::Less, {0, kBeyond}), compare(number, Operator::Greater, {0, -kBeyond}));
  ValuePtr finite = make(ValueKind::Standard, a_.type_table().boolean(), number.where);
  finite->function = StandardFunction::IsValid;
  finite->operands.push_back(again(number));
  return neither(both(std::move(finite), neither(std::move(held))));
}

// Its nanoseconds are an LINT.
ValuePtr ValueCondition::is_duration(const Value& called) {
  const Value& first = *called.operands[0];
  const Position where = first.where;
  const Type* real = a_.type_table().elementary(ElementaryType::Lreal);
  constexpr double kLimit = 9223372036854775808.0;
  const auto in_ns = [&] {
    const auto unit = static_cast<double>(time_unit_ns(*called.type));
    return e_.operators().combine(Operator::Multiply, convert_exactly(again(first), real),
                                  make_constant({0, unit}, real, where), where);
  };
  return both(
      e_.operators().combine(Operator::GreaterEqual, in_ns(), make_constant({0, -kLimit}, real, where),
                             where),
      e_.operators().combine(Operator::Less, in_ns(), make_constant({0, kLimit}, real, where), where));
}

// NaN is no error of these.
ValuePtr ValueCondition::is_in_domain(const Value& called) {
  const Value& first = *called.operands[0];
  if (called.function == StandardFunction::Sqrt) return neither(compare(first, Operator::Less, {0, 0.0}));
  if (called.function == StandardFunction::Ln || called.function == StandardFunction::Log)
    return neither(compare(first, Operator::LessEqual, {0, 0.0}));
  return both(neither(compare(first, Operator::Less, {0, -1.0})),
              neither(compare(first, Operator::Greater, {0, 1.0})));
}

// 0 has no negative power. A finite negative number has a power if the exponent is an integer, as every real
// from 2**53 on is; NaN and the infinities are no error.
ValuePtr ValueCondition::is_power(const Value& base, const Value& exponent) {
  constexpr double kWhole = 9007199254740992.0;
  const Position where = base.where;
  const double most = base.type->size == 4 ? static_cast<double>(std::numeric_limits<float>::max())
                                           : std::numeric_limits<double>::max();
  ValuePtr pole = both(compare(base, Operator::Equal, {0, 0.0}), compare(exponent, Operator::Less, {0, 0.0}));
  ValuePtr roots =
      both(compare(base, Operator::Less, {0, 0.0}), compare(base, Operator::GreaterEqual, {0, -most}));
  ValuePtr small = both(compare(exponent, Operator::Less, {0, kWhole}),
                        compare(exponent, Operator::Greater, {0, -kWhole}));
  ValuePtr whole = make(ValueKind::Truncate, a_.type_table().elementary(ElementaryType::Lint), where);
  whole->operands.push_back(again(exponent));
  whole = e_.operators().combine(Operator::Equal, convert_exactly(std::move(whole), exponent.type),
                                 again(exponent), where);
  // Cut only if the integer type holds it.
  ValuePtr has_root = neither(both(std::move(roots), std::move(small)));
  if (!has_root || !whole) return nullptr;
  return both(neither(std::move(pole)),
              e_.operators().combine(Operator::OrElse, std::move(has_root), std::move(whole), where));
}

ValuePtr ValueCondition::takes_arguments(const Value& called) {
  const Pou* condition = condition_of(*called.pou);
  pou_.note_callee(*condition);
  ValuePtr asked = make(ValueKind::Call, a_.type_table().boolean(), called.where);
  asked->pou = condition;
  for (const ValuePtr& each : called.operands) asked->operands.push_back(again(*each));
  return asked;
}

// Integers are read as 64 bits, which the type must hold.
ValuePtr ValueCondition::is_literal(const Value& called) {
  const auto number = static_cast<std::uint8_t>(called.text_op);
  const auto read = static_cast<StringOpId>(number - number % 2);
  const Value& text = *called.operands[0];
  const Type& type = *called.type;
  const TypeTable& types = a_.type_table();
  ValuePtr good = text_operation(bytecode::test_of(read), types.boolean(), again(text), text.where);
  const bool narrow = (type.is_integer() || type.is_bits()) && type.size < 8;
  if (!narrow) return good;
  const Type* whole = types.elementary(type.is_unsigned() ? ElementaryType::Ulint : ElementaryType::Lint);
  const IntegerRange range = range_of(type.elementary);
  const auto bounded = [&](Operator op, __int128 bound) {
    return e_.operators().combine(op, text_operation(read, whole, again(text), text.where),
                                  make_constant({bound}, whole, text.where), text.where);
  };
  ValuePtr held = bounded(Operator::LessEqual, range.high);
  if (!type.is_unsigned()) held = both(bounded(Operator::GreaterEqual, range.low), std::move(held));
  return e_.operators().combine(Operator::AndThen, std::move(good), std::move(held), text.where);
}

// BCD compares as what it stands for.
ValuePtr ValueCondition::is_code(const Value& code, const Type& number) {
  ValuePtr valid = make(ValueKind::Standard, a_.type_table().boolean(), code.where);
  valid->function = StandardFunction::IsValidBcd;
  valid->operands.push_back(again(code));
  const __int128 most = range_of(number.elementary).high;
  if (most >= most_of_digits(code.type->bit_count() / 4)) return valid;
  return both(std::move(valid), compare(code, Operator::LessEqual, {as_bcd(most)}));
}

ValuePtr ValueCondition::has_digits(const Value& number, const Type& code) {
  const __int128 most = most_of_digits(code.bit_count() / 4);
  const IntegerRange range = range_of(number.type->elementary);
  ValuePtr positive = compare(number, Operator::GreaterEqual, {0});
  return most >= range.high ? std::move(positive)
                            : both(std::move(positive), compare(number, Operator::LessEqual, {most}));
}

}  // namespace stepwright::semantics::internal
