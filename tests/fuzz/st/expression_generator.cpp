#include "tests/fuzz/st/expression_generator.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace stepwright::st_fuzz {

namespace {

template <typename... Operands>
std::vector<ExpressionPtr> list(Operands... operands) {
  std::vector<ExpressionPtr> out;
  (out.push_back(std::move(operands)), ...);
  return out;
}

std::uint64_t real_bits(Scalar type, double value) {
  if (type == Scalar::Lreal) return std::bit_cast<std::uint64_t>(value);
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

}  // namespace

ExpressionPtr ExpressionGenerator::make(Operation operation, Scalar type) {
  auto out = std::make_unique<Expression>();
  out->operation = operation;
  out->type = elementary(type);
  return out;
}

ExpressionPtr ExpressionGenerator::node(Operation operation, Scalar type,
                                        std::vector<ExpressionPtr> operands) {
  ExpressionPtr out = make(operation, type);
  out->constant = std::ranges::all_of(operands, [](const auto& each) { return each->constant; });
  out->operands = std::move(operands);
  return out;
}

ExpressionPtr ExpressionGenerator::load(Place place) {
  const Scalar type = place.bit >= 0 ? Scalar::Bool : place.type->scalar;
  ExpressionPtr out = make(Operation::Load, type);
  if (place.type->kind == TypeKind::Enumeration) out->type = place.type;
  out->place = std::move(place);
  return out;
}

ExpressionPtr ExpressionGenerator::small_literal(Scalar type, std::int64_t low, std::int64_t high) {
  ExpressionPtr out = make(Operation::Literal, type);
  out->constant = true;
  const std::int64_t number = random_.between(low, high);
  out->bits = is_real(type) ? real_bits(type, static_cast<double>(number) / 4)
                            : extended(type, static_cast<std::uint64_t>(number));
  return out;
}

ExpressionPtr ExpressionGenerator::literal(Scalar type) {
  if (type == Scalar::Bool) return small_literal(type, 0, 1);
  if (is_real(type)) {
    ExpressionPtr out = small_literal(type, -400, 400);
    if (random_.chance(25))
      out->bits =
          real_bits(type, random_.pick({0.0, 1.0, -1.0, 0.1, 3.25e9, -7.5e18, 1e-20, 2.5, 0.5, 1.7e38}));
    return out;
  }
  const bool has_sign = is_signed(type);
  ExpressionPtr out = small_literal(type, has_sign ? -9 : 0, has_sign ? 20 : 30);
  if (type == Scalar::Time) out->bits *= random_.pick<std::uint64_t>({1, 1000, 1'000'000, 250'000'000});
  if (!random_.chance(30)) return out;
  const std::uint64_t top = std::uint64_t{1} << (bits_of(type) - 1);
  // The smallest number has no literal of its own in some writings of the standard.
  out->bits = extended(
      type, random_.pick<std::uint64_t>({top - 1, top + 1, 0, 1, ~std::uint64_t{0}, random_.next()}));
  return out;
}

ExpressionPtr ExpressionGenerator::leaf(Scalar type, int depth) {
  const auto& ways = scope_.readable[static_cast<unsigned>(type)];
  if (!ways.empty() && random_.chance(75)) return load(place(random_.pick(ways), std::min(depth, 0)));
  return literal(type);
}

ExpressionPtr ExpressionGenerator::varying(Scalar type, int depth) {
  ExpressionPtr out = exact(type, depth);
  if (!out->constant) return out;
  const auto& ways = scope_.readable[static_cast<unsigned>(type)];
  if (!ways.empty()) return load(place(random_.pick(ways), std::min(depth, 0)));
  return nullptr;
}

ExpressionPtr ExpressionGenerator::unknown(Scalar type, int depth) {
  if (ExpressionPtr out = varying(type, depth)) return out;
  for (unsigned i = 0; i < kScalars; ++i) {
    const auto from = static_cast<Scalar>(i);
    if (is_integer(from) && !scope_.readable[i].empty())
      return convert(load(place(random_.pick(scope_.readable[i]), 0)), type);
  }
  return literal(type);
}

ExpressionPtr ExpressionGenerator::divisor(Scalar type, int depth) {
  ExpressionPtr out = random_.chance(45) ? varying(type, depth) : nullptr;
  if (out && random_.chance(95)) {
    // Made unlikely to be zero.
    if (is_real(type)) out = node(Operation::Abs, type, list(std::move(out)));
    const Operation operation = is_real(type) ? Operation::Add : Operation::Max;
    return node(operation, type, list(std::move(out), small_literal(type, 1, 7)));
  }
  if (out) return out;
  out = literal(type);
  const bool zero = is_real(type) ? real_bits(type, 0.0) == out->bits : out->bits == 0;
  return zero ? small_literal(type, 1, 9) : std::move(out);
}

ExpressionPtr ExpressionGenerator::clamped(ExpressionPtr value, std::int64_t low, std::int64_t high) {
  const Scalar type = value->type->scalar;
  const auto bound = [&](std::int64_t at) {
    const std::int64_t scaled = is_real(type) ? at * 4 : at;
    return small_literal(type, scaled, scaled);
  };
  if (random_.chance(50))
    return node(Operation::Limit, type, list(bound(low), std::move(value), bound(high)));
  ExpressionPtr upper = node(Operation::Min, type, list(bound(high), std::move(value)));
  return node(Operation::Max, type, list(std::move(upper), bound(low)));
}

ExpressionPtr ExpressionGenerator::index(const Bounds& bounds, int depth) {
  const Scalar type = bounds.low < 0 || random_.chance(60)
                          ? random_.pick({Scalar::Sint, Scalar::Int, Scalar::Dint})
                          : random_.pick({Scalar::Usint, Scalar::Uint});
  // An index may have indexes; deeper down they are plain.
  ExpressionPtr out = depth > -2 && random_.chance(75) ? varying(type, depth) : nullptr;
  if (!out) return small_literal(type, bounds.low, bounds.high);
  if (random_.chance(1)) return out;
  return clamped(std::move(out), bounds.low, bounds.high);
}

Place ExpressionGenerator::place(const Way& way, int depth) {
  Place out;
  out.variable = way.variable;
  out.type = way.type;
  for (const WayStep& each : way.steps) {
    Step step;
    step.field = each.field;
    step.array = each.array;
    if (each.array != nullptr)
      for (const Bounds& bounds : each.array->bounds) step.indexes.push_back(index(bounds, depth - 1));
    out.steps.push_back(std::move(step));
  }
  return out;
}

Place ExpressionGenerator::maybe_bit(Place place) {
  const bool has_bits = place.type->is_scalar() && is_bits(place.type->scalar);
  return has_bits && random_.chance(30) ? bit(std::move(place)) : std::move(place);
}

Place ExpressionGenerator::bit(Place place) {
  place.bit = static_cast<int>(random_.below(bits_of(place.type->scalar)));
  return place;
}

ExpressionPtr ExpressionGenerator::assignable(const Type& type, int depth) {
  if (type.kind == TypeKind::Enumeration) return of_enumeration(type, depth);
  if (type.kind == TypeKind::Elementary) return value(type.scalar, depth);
  ExpressionPtr out = varying(type.scalar, depth);
  if (!out) return small_literal(type.scalar, type.low, type.high);
  return random_.chance(97) ? clamped(std::move(out), type.low, type.high) : std::move(out);
}

ExpressionPtr ExpressionGenerator::bounded(const Type& type, int depth) {
  ExpressionPtr out = varying(type.scalar, depth);
  if (!out) return small_literal(type.scalar, type.low, type.high);
  return clamped(std::move(out), type.low, type.high);
}

ExpressionPtr ExpressionGenerator::of_enumeration(const Type& type, int depth) {
  std::vector<const Way*> known;
  for (const Way& each : scope_.enumerations)
    if (each.type == &type) known.push_back(&each);
  if (!known.empty() && random_.chance(40)) return load(place(*random_.pick(known), depth));
  ExpressionPtr out = make(Operation::Literal, type.scalar);
  if (depth > 0 && random_.chance(30)) {
    out = node(Operation::Sel, type.scalar,
               list(exact(Scalar::Bool, depth - 1), of_enumeration(type, 0), of_enumeration(type, 0)));
  } else {
    out->constant = true;
    out->bits = static_cast<std::uint64_t>(type.low) + random_.below(type.enumerators.size());
  }
  out->type = &type;
  return out;
}

ExpressionPtr ExpressionGenerator::value(Scalar type, int depth) {
  if (!random_.chance(20)) return exact(type, depth);
  std::vector<Scalar> narrower;
  for (unsigned i = 0; i < kScalars; ++i)
    if (widens(static_cast<Scalar>(i), type)) narrower.push_back(static_cast<Scalar>(i));
  if (narrower.empty()) return exact(type, depth);
  return node(Operation::Widen, type, list(exact(random_.pick(narrower), depth)));
}

ExpressionPtr ExpressionGenerator::exact(Scalar type, int depth) {
  if (depth <= 0 || random_.chance(15)) return leaf(type, depth);
  if (random_.chance(12)) return selection(type, depth - 1);
  if (random_.chance(10)) return call(type, depth - 1);
  if (type != Scalar::Bool && random_.chance(15)) return conversion(type, depth - 1);
  if (type == Scalar::Bool) return boolean(depth - 1);
  if (type == Scalar::Time) return time(depth - 1);
  if (is_real(type)) return real(type, depth - 1);
  return is_bits(type) ? bit_string(type, depth - 1) : integer(type, depth - 1);
}

ExpressionPtr ExpressionGenerator::arithmetic(Operation operation, Scalar type, int depth) {
  ExpressionPtr left = exact(type, depth);
  const bool divides = operation == Operation::Divide || operation == Operation::Modulo;
  ExpressionPtr right = divides ? divisor(type, depth) : value(type, depth);
  return node(operation, type, list(std::move(left), std::move(right)));
}

ExpressionPtr ExpressionGenerator::call(Scalar type, int depth) {
  std::vector<const Pou*> known;
  for (const Pou& each : program_.pous) {
    const bool plain = std::ranges::all_of(each.variables, [](const Variable& variable) {
      return variable.section != Section::InOut && variable.section != Section::Output;
    });
    if (each.kind == PouKind::Function && plain && each.result->scalar == type &&
        each.result->kind != TypeKind::Enumeration)
      known.push_back(&each);
  }
  if (known.empty()) return leaf(type, depth);
  ExpressionPtr out = make(Operation::Call, type);
  out->callee = random_.pick(known);
  for (const Variable& each : out->callee->variables)
    if (each.section == Section::Input) out->operands.push_back(assignable(*each.type, depth));
  return out;
}

ExpressionPtr ExpressionGenerator::selection(Scalar type, int depth) {
  if (random_.chance(50))
    return node(Operation::Sel, type,
                list(exact(Scalar::Bool, depth), exact(type, depth), value(type, depth)));
  const auto count = random_.between(2, 4);
  ExpressionPtr number = varying(Scalar::Int, depth);
  if (!number) {
    number = small_literal(Scalar::Int, 0, count - 1);
  } else if (random_.chance(99)) {
    number = clamped(std::move(number), 0, count - 1);
  }
  std::vector<ExpressionPtr> operands = list(std::move(number));
  for (int i = 0; i < count; ++i) operands.push_back(i == 0 ? exact(type, depth) : value(type, depth));
  if (operands[0]->type->scalar != Scalar::Dint)
    operands[0] = node(Operation::Widen, Scalar::Dint, list(std::move(operands[0])));
  return node(Operation::Mux, type, std::move(operands));
}

}  // namespace stepwright::st_fuzz
