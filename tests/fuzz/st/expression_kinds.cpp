// The operations of each kind of type.

#include <utility>

#include "tests/fuzz/st/expression_generator.h"

namespace stepwright::st_fuzz {

namespace {

template <typename... Operands>
std::vector<ExpressionPtr> list(Operands... operands) {
  std::vector<ExpressionPtr> out;
  (out.push_back(std::move(operands)), ...);
  return out;
}

Scalar any_integer(Random& random) {
  return static_cast<Scalar>(random.between(static_cast<int>(Scalar::Sint), static_cast<int>(Scalar::Ulint)));
}

Scalar any_bits(Random& random) {
  return static_cast<Scalar>(random.between(static_cast<int>(Scalar::Byte), static_cast<int>(Scalar::Lword)));
}

}  // namespace

ExpressionPtr ExpressionGenerator::comparison(int depth) {
  const Operation operation =
      random_.pick({Operation::Equal, Operation::NotEqual, Operation::Less, Operation::Greater,
                    Operation::LessEqual, Operation::GreaterEqual});
  if (!scope_.enumerations.empty() && random_.chance(15)) {
    const Type& type = *random_.pick(scope_.enumerations).type;
    const Operation equality = random_.pick({Operation::Equal, Operation::NotEqual});
    return node(equality, Scalar::Bool, list(of_enumeration(type, depth), of_enumeration(type, 0)));
  }
  const auto type = static_cast<Scalar>(random_.below(kScalars));
  return node(operation, Scalar::Bool, list(exact(type, depth), value(type, depth)));
}

ExpressionPtr ExpressionGenerator::boolean(int depth) {
  const auto logic = [&](Operation operation) {
    return node(operation, Scalar::Bool, list(exact(Scalar::Bool, depth), exact(Scalar::Bool, depth)));
  };
  switch (random_.below(9)) {
    case 0:
      return logic(Operation::And);
    case 1:
      return logic(Operation::Or);
    case 2:
      return logic(Operation::Xor);
    case 3:
      return node(Operation::Not, Scalar::Bool, list(exact(Scalar::Bool, depth)));
    case 4:
      return logic(random_.pick({Operation::AndThen, Operation::OrElse}));
    case 5: {
      const auto& ways = scope_.readable[static_cast<unsigned>(any_bits(random_))];
      return ways.empty() ? comparison(depth) : load(bit(place(random_.pick(ways), depth)));
    }
    case 6:
      return convert(exact(any_integer(random_), depth), Scalar::Bool);
    default:
      return comparison(depth);
  }
}

// More operands wait for one another than a machine has registers, a comparison on top of them.
ExpressionPtr ExpressionGenerator::chain(Scalar type) {
  ExpressionPtr out = convert(comparison(1), type);
  const auto count = random_.between(6, 14);
  for (std::int64_t i = 0; i < count; ++i)
    out =
        node(random_.pick({Operation::Add, Operation::Subtract}), type, list(leaf(type, 0), std::move(out)));
  return out;
}

ExpressionPtr ExpressionGenerator::integer(Scalar type, int depth) {
  if (random_.chance(2)) return chain(type);
  switch (random_.below(10)) {
    case 0:
    case 1:
      return arithmetic(Operation::Add, type, depth);
    case 2:
      return arithmetic(Operation::Subtract, type, depth);
    case 3:
      return arithmetic(Operation::Multiply, type, depth);
    case 4:
      return arithmetic(Operation::Divide, type, depth);
    case 5:
      // Modulo zero has a value.
      if (random_.chance(50)) return arithmetic(Operation::Modulo, type, depth);
      if (ExpressionPtr right = varying(type, depth))
        return node(Operation::Modulo, type, list(exact(type, depth), std::move(right)));
      return leaf(type, depth);
    case 6:
      return is_signed(type) ? node(Operation::Negate, type, list(exact(type, depth)))
                             : arithmetic(Operation::Subtract, type, depth);
    case 7:
      return node(Operation::Abs, type, list(exact(type, depth)));
    case 8:
      return node(random_.pick({Operation::Min, Operation::Max}), type,
                  list(exact(type, depth), value(type, depth), value(type, depth)));
    default:
      return node(Operation::Limit, type, list(value(type, depth), exact(type, depth), value(type, depth)));
  }
}

ExpressionPtr ExpressionGenerator::bit_string(Scalar type, int depth) {
  const auto logic = [&](Operation operation) {
    return node(operation, type, list(exact(type, depth), value(type, depth)));
  };
  switch (random_.below(6)) {
    case 0:
      return logic(random_.pick({Operation::Min, Operation::Max}));
    case 1:
      return logic(Operation::And);
    case 2:
      return logic(Operation::Or);
    case 3:
      return logic(Operation::Xor);
    case 4:
      return node(Operation::Not, type, list(exact(type, depth)));
    default: {
      // A negative number of places ends the scan: most are small.
      ExpressionPtr count = random_.chance(85) ? nullptr : varying(Scalar::Dint, depth);
      if (!count) count = small_literal(Scalar::Dint, 0, 70);
      return node(random_.pick({Operation::Shl, Operation::Shr, Operation::Rol, Operation::Ror}), type,
                  list(exact(type, depth), std::move(count)));
    }
  }
}

ExpressionPtr ExpressionGenerator::real(Scalar type, int depth) {
  switch (random_.below(10)) {
    case 0:
    case 1:
      return arithmetic(Operation::Add, type, depth);
    case 2:
      return arithmetic(Operation::Subtract, type, depth);
    case 3:
      return arithmetic(Operation::Multiply, type, depth);
    case 4:
      return arithmetic(Operation::Divide, type, depth);
    case 5:
      return node(Operation::Negate, type, list(exact(type, depth)));
    case 6:
      return node(random_.pick({Operation::Min, Operation::Max}), type,
                  list(exact(type, depth), value(type, depth)));
    case 7:
      return node(Operation::Limit, type, list(value(type, depth), exact(type, depth), value(type, depth)));
    case 8: {
      ExpressionPtr operand = exact(type, depth);
      if (random_.chance(90)) operand = node(Operation::Abs, type, list(std::move(operand)));
      const Operation which = random_.chance(70) ? Operation::Sqrt : Operation::Ln;
      if (which == Operation::Ln && random_.chance(90))
        operand = node(Operation::Add, type, list(std::move(operand), small_literal(type, 1, 8)));
      return node(which, type, list(std::move(operand)));
    }
    case 9:
      if (random_.chance(50)) {
        ExpressionPtr base = exact(type, depth);
        if (random_.chance(90))
          base = node(Operation::Add, type,
                      list(node(Operation::Abs, type, list(std::move(base))), small_literal(type, 1, 8)));
        return node(Operation::Power, type, list(std::move(base), value(type, depth)));
      }
      [[fallthrough]];
    default:
      return node(random_.pick({Operation::Sin, Operation::Atan, Operation::Exp, Operation::Abs}), type,
                  list(exact(type, depth)));
  }
}

// TIME * and / number count the number as LINT (6.6.2.5.12).
ExpressionPtr ExpressionGenerator::time(int depth) {
  const Operation operation = random_.pick(
      {Operation::Add, Operation::Subtract, Operation::Multiply, Operation::Divide, Operation::Min});
  if (operation == Operation::Multiply || operation == Operation::Divide) {
    ExpressionPtr number =
        operation == Operation::Divide ? divisor(Scalar::Lint, depth) : value(Scalar::Lint, depth);
    return node(operation, Scalar::Time, list(exact(Scalar::Time, depth), std::move(number)));
  }
  return node(operation, Scalar::Time, list(exact(Scalar::Time, depth), exact(Scalar::Time, depth)));
}

ExpressionPtr ExpressionGenerator::convert(ExpressionPtr value, Scalar to) {
  ExpressionPtr out = node(Operation::Convert, to, list(std::move(value)));
  out->anonymous = random_.chance(40);
  return out;
}

// Within the target mostly.
ExpressionPtr ExpressionGenerator::from_real(Scalar to, int depth) {
  const Scalar from = random_.pick({Scalar::Real, Scalar::Lreal});
  ExpressionPtr value = exact(from, depth);
  if (random_.chance(96)) value = clamped(std::move(value), is_signed(to) ? -120 : 0, 120);
  if (to == Scalar::Time || random_.chance(60)) return convert(std::move(value), to);
  return node(Operation::Truncate, to, list(std::move(value)));
}

ExpressionPtr ExpressionGenerator::conversion(Scalar type, int depth) {
  if (is_real(type)) {
    const unsigned which = static_cast<unsigned>(random_.below(10));
    if (which == 0 && type == Scalar::Real) return convert(exact(Scalar::Lreal, depth), type);
    if (which == 1 && type == Scalar::Lreal) return convert(exact(Scalar::Real, depth), type);
    if (which == 2) return convert(exact(Scalar::Time, depth), type);
    if (which == 3) return convert(exact(Scalar::Bool, depth), type);
    return convert(exact(any_integer(random_), depth), type);
  }
  if (type == Scalar::Time)
    return random_.chance(30) ? from_real(type, depth) : convert(exact(any_integer(random_), depth), type);
  if (is_integer(type) && random_.chance(30)) return from_real(type, depth);
  if (is_integer(type) && random_.chance(15)) return convert(exact(Scalar::Time, depth), type);
  if (random_.chance(10)) return convert(exact(Scalar::Bool, depth), type);
  if (is_integer(type) && !scope_.enumerations.empty() && random_.chance(15)) {
    ExpressionPtr out = convert(of_enumeration(*random_.pick(scope_.enumerations).type, depth), type);
    out->anonymous = true;
    return out;
  }
  const Scalar from = random_.chance(50) ? any_integer(random_) : any_bits(random_);
  return from == type ? leaf(type, depth) : convert(exact(from, depth), type);
}

}  // namespace stepwright::st_fuzz
