#include "ladder/semantics/constants/constant_function.h"

#include <bit>
#include <cmath>
#include <limits>

namespace stepwright::semantics {

namespace {

using enum StandardFunction;
using Operands = std::span<const Constant>;

__int128 magnitude(__int128 value) {
  return value < 0 ? -value : value;
}

// Elementary functions, in double; nothing outside of their domain, where the machine traps.
std::optional<double> elementary(StandardFunction function, double x) {
  switch (function) {
    case Sqrt:
      return x < 0 ? std::nullopt : std::optional(std::sqrt(x));
    case Sin:
      return std::sin(x);
    case Cos:
      return std::cos(x);
    case Tan:
      return std::tan(x);
    case Asin:
      return std::abs(x) <= 1 ? std::optional(std::asin(x)) : std::nullopt;
    case Acos:
      return std::abs(x) <= 1 ? std::optional(std::acos(x)) : std::nullopt;
    case Atan:
      return std::atan(x);
    case Exp:
      return std::exp(x);
    case Ln:
      return x > 0 ? std::optional(std::log(x)) : std::nullopt;
    case Log:
      return x > 0 ? std::optional(std::log10(x)) : std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<double> real_function(StandardFunction function, Operands operands) {
  const double x = operands[0].real;
  switch (function) {
    case Abs:
      return std::abs(x);
    case Atan2:
      return std::atan2(x, operands[1].real);
    case Power: {
      const double power = std::pow(x, operands[1].real);
      const bool undefined = std::isnan(power) || (x == 0 && operands[1].real < 0);
      return undefined ? std::nullopt : std::optional(power);
    }
    case Min:
    case Max: {
      double best = x;
      for (const Constant& each : operands.subspan(1)) {
        if (std::isnan(best) || std::isnan(each.real)) return std::nullopt;
        best = function == Min ? std::min(best, each.real) : std::max(best, each.real);
      }
      return best;
    }
    default:
      return elementary(function, x);
  }
}

std::uint64_t swapped(std::uint64_t value, std::uint32_t bytes) {
  std::uint64_t result = 0;
  for (std::uint32_t i = 0; i < bytes; ++i) result |= (value >> (8 * i) & 0xFF) << (8 * (bytes - 1 - i));
  return result;
}

std::optional<Constant> shifted(StandardFunction function, Operands operands, const Type& type) {
  const unsigned bits = type.bit_count();
  const __int128 mask = (static_cast<__int128>(1) << bits) - 1;
  const __int128 value = operands[0].integer & mask;
  const __int128 count = operands[1].integer;
  if (count < 0) return std::nullopt;
  if (function == Shl) return Constant{count >= bits ? 0 : (value << static_cast<int>(count)) & mask};
  if (function == Shr) return Constant{count >= bits ? 0 : value >> static_cast<int>(count)};
  const auto turn = static_cast<int>(count % bits);
  const int left = function == Rol ? turn : static_cast<int>(bits) - turn;
  return Constant{((value << left) | (value >> (static_cast<int>(bits) - left))) & mask};
}

std::optional<Constant> from_bcd(std::uint64_t code, const Type& result) {
  Constant value;
  for (int shift = 60; shift >= 0; shift -= 4) {
    const std::uint64_t digit = code >> shift & 15;
    if (digit > 9) return std::nullopt;
    value.integer = value.integer * 10 + static_cast<__int128>(digit);
  }
  return fits(value, result) ? std::optional(value) : std::nullopt;
}

std::optional<Constant> to_bcd(__int128 value, const Type& result) {
  if (value < 0) return std::nullopt;
  Constant code;
  for (unsigned shift = 0; value != 0; shift += 4, value /= 10) {
    if (shift >= result.bit_count()) return std::nullopt;
    code.integer |= (value % 10) << shift;
  }
  return code;
}

// Since midnight, also before 1970.
__int128 time_of_day(__int128 ns) {
  constexpr __int128 kDay = 86'400'000'000'000;
  return (ns % kDay + kDay) % kDay;
}

bool is_bcd(std::uint64_t code) {
  return (code >> 3 & (code >> 2 | code >> 1) & 0x1111111111111111u) == 0;
}

std::optional<Constant> integer_function(StandardFunction function, Operands operands, const Type& type,
                                         const Type& result) {
  const __int128 value = operands[0].integer;
  switch (function) {
    case Abs:
      return wrapped({magnitude(value)}, type);
    case Min:
    case Max: {
      __int128 best = value;
      for (const Constant& each : operands.subspan(1))
        if (function == Min ? each.integer < best : each.integer > best) best = each.integer;
      return Constant{best};
    }
    case Shl:
    case Shr:
    case Rol:
    case Ror:
      return shifted(function, operands, type);
    case SwapBytes:
      return wrapped({static_cast<__int128>(swapped(static_cast<std::uint64_t>(value), type.size))}, type);
    case DayOf:
      return Constant{value - time_of_day(value)};
    case TimeOfDay:
      return Constant{time_of_day(value)};
    case FromBcd:
      return from_bcd(static_cast<std::uint64_t>(value), result);
    case ToBcd:
      return to_bcd(value, result);
    case IsValidBcd:
      return Constant{is_bcd(static_cast<std::uint64_t>(value)) ? 1 : 0};
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Constant> evaluate(StandardFunction function, std::span<const Constant> operands,
                                 const Type& operand_type, const Type& result) {
  if (!operand_type.is_real()) return integer_function(function, operands, operand_type, result);
  if (function == IsValid) return Constant{std::isfinite(operands[0].real) ? 1 : 0};
  const auto value = real_function(function, operands);
  return value ? std::optional(wrapped({0, *value}, result)) : std::nullopt;
}

Constant widest_of(std::span<const ValuePtr> values) {
  Constant widest;
  for (const ValuePtr& each : values) {
    const __int128 difference = magnitude(each->constant.integer) - magnitude(widest.integer);
    // Of -n and n the positive one needs more bits.
    if (difference > 0 || (difference == 0 && each->constant.integer > 0))
      widest.integer = each->constant.integer;
    if (std::abs(each->constant.real) > std::abs(widest.real)) widest.real = each->constant.real;
  }
  return widest;
}

}  // namespace stepwright::semantics
