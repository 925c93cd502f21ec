#pragma once

// The meaning of the arithmetic instructions, defined for every input (IEC 61131-3, 6.6.2.5; where the
// standard leaves a choice, runtime/doc/bytecode_format.md says which one this is). Engines and tests share
// it.

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "runtime/bytecode/value_type.h"

namespace stepwright::operations {

// Two's complement wrap-around.
template <std::unsigned_integral U>
constexpr U negate(U x) {
  return static_cast<U>(U{0} - x);
}

// Signed division truncates towards zero; the smallest number divided by -1 wraps to itself.
// Requires y != 0.
template <std::signed_integral T>
constexpr T divide(T x, T y) {
  using U = std::make_unsigned_t<T>;
  return y == -1 ? static_cast<T>(negate(static_cast<U>(x))) : static_cast<T>(x / y);
}
template <std::unsigned_integral T>
constexpr T divide(T x, T y) {
  return static_cast<T>(x / y);
}

// The remainder has the sign of x; x MOD 0 is 0 (IEC 61131-3, the definition of MOD).
template <std::integral T>
constexpr T modulo(T x, T y) {
  if (y == 0) return 0;
  if constexpr (std::is_signed_v<T>) {
    if (y == -1) return 0;
  }
  return static_cast<T>(x % y);
}

// Shifts fill with zeros; a count outside 0..width-1 shifts everything out.
template <std::unsigned_integral U>
constexpr U shift_left(U x, std::uint32_t count) {
  return count < static_cast<std::uint32_t>(std::numeric_limits<U>::digits) ? static_cast<U>(x << count)
                                                                            : U{0};
}
template <std::unsigned_integral U>
constexpr U shift_right(U x, std::uint32_t count) {
  return count < static_cast<std::uint32_t>(std::numeric_limits<U>::digits) ? static_cast<U>(x >> count)
                                                                            : U{0};
}

// Rotates the lowest `bits` (8, 16 or 32) of x and clears the others; the count is taken modulo `bits`.
constexpr std::uint32_t rotate_left(std::uint32_t x, std::uint32_t count, std::uint32_t bits) {
  const std::uint32_t mask = bits == 32 ? 0xFFFFFFFFu : (1u << bits) - 1;
  const std::uint32_t value = x & mask;
  const std::uint32_t by = count & (bits - 1);
  return ((value << by) | (value >> ((bits - by) & (bits - 1)))) & mask;
}
constexpr std::uint32_t rotate_right(std::uint32_t x, std::uint32_t count, std::uint32_t bits) {
  return rotate_left(x, bits - (count & (bits - 1)), bits);
}

// Result of an operation on x and y; a NaN becomes the same NaN on every machine: that of x, else that of y,
// made quiet, else a negative one without a payload. (Which operand's NaN comes out is the compiler's
// choice.)
template <std::floating_point T>
constexpr T settle_nan(T result, T x, T y) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  if (result == result) [[likely]]
    return result;
  constexpr Bits kQuiet = Bits{1} << (std::numeric_limits<T>::digits - 2);
  if (x != x) return std::bit_cast<T>(std::bit_cast<Bits>(x) | kQuiet);
  if (y != y) return std::bit_cast<T>(std::bit_cast<Bits>(y) | kQuiet);
  return std::bit_cast<T>(std::bit_cast<Bits>(std::numeric_limits<T>::infinity()) | kQuiet |
                          Bits{1} << (sizeof(T) * 8 - 1));
}

// To the nearest integer, ties to even (IEC 61131-3 refers to IEC 60559). Independent of library and
// instruction set: adding 2^52 leaves no room for a fraction.
constexpr double round_to_even(double x) {
  constexpr double kNoFraction = 4503599627370496.0;
  if (!(x < kNoFraction && x > -kNoFraction)) return x;
  return x >= 0 ? (x + kNoFraction) - kNoFraction : (x - kNoFraction) + kNoFraction;
}

constexpr double truncate(double x) {
  constexpr double kNoFraction = 4503599627370496.0;
  if (!(x < kNoFraction && x > -kNoFraction)) return x;
  return static_cast<double>(static_cast<std::int64_t>(x));
}

// The slot of an integral number as the target type; false for NaN and numbers outside its range.
constexpr bool to_integer(double x, bytecode::IntType type, std::uint64_t& slot) {
  constexpr double kTwoTo63 = 9223372036854775808.0;
  constexpr double kLowest[bytecode::kIntTypeCount] = {-128, 0, -32768, 0, -2147483648.0, 0, -kTwoTo63, 0};
  constexpr double kBeyond[bytecode::kIntTypeCount] = {128,          256,          32768,    65536,
                                                       2147483648.0, 4294967296.0, kTwoTo63, 2 * kTwoTo63};
  const auto index = static_cast<std::uint8_t>(type);
  if (!(x >= kLowest[index] && x < kBeyond[index])) return false;
  if (type == bytecode::IntType::U64) {
    slot = static_cast<std::uint64_t>(x);
  } else if (type == bytecode::IntType::I64) {
    slot = static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
  } else {
    slot = static_cast<std::uint32_t>(static_cast<std::int64_t>(x));
  }
  return true;
}

}  // namespace stepwright::operations
