#include "runtime/operations/arithmetic.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace stepwright::operations {
namespace {

using bytecode::IntType;

TEST(Arithmetic, Divide_WhenTheQuotientOverflows_ThenWraps) {
  EXPECT_EQ(divide<std::int32_t>(INT32_MIN, -1), INT32_MIN);
  EXPECT_EQ(divide<std::int64_t>(INT64_MIN, -1), INT64_MIN);
  EXPECT_EQ(divide<std::int32_t>(-7, 2), -3);
  EXPECT_EQ(divide<std::uint32_t>(0xFFFFFFFEu, 2), 0x7FFFFFFFu);
}

TEST(Arithmetic, Modulo_WhenDivisorIsZeroOrMinusOne_ThenIsZero) {
  EXPECT_EQ(modulo<std::int32_t>(5, 0), 0);
  EXPECT_EQ(modulo<std::uint64_t>(5, 0), 0u);
  EXPECT_EQ(modulo<std::int64_t>(INT64_MIN, -1), 0);
  EXPECT_EQ(modulo<std::int32_t>(-7, 3), -1);
}

TEST(Arithmetic, Shift_WhenTheCountReachesTheWidth_ThenIsZero) {
  EXPECT_EQ(shift_left<std::uint32_t>(1, 31), 0x80000000u);
  EXPECT_EQ(shift_left<std::uint32_t>(1, 32), 0u);
  EXPECT_EQ(shift_right<std::uint64_t>(~0ull, 63), 1u);
  EXPECT_EQ(shift_right<std::uint64_t>(~0ull, 0xFFFFFFFFu), 0u);
}

TEST(Arithmetic, Rotate_WhenNarrow_ThenStaysInItsWidth) {
  EXPECT_EQ(rotate_left(0x81, 1, 8), 0x03u);
  EXPECT_EQ(rotate_right(0x81, 1, 8), 0xC0u);
  EXPECT_EQ(rotate_left(0xFF8001, 4, 16), 0x0018u);
  EXPECT_EQ(rotate_left(0x80000001u, 33, 32), 0x00000003u);
  EXPECT_EQ(rotate_right(0x12345678u, 0, 32), 0x12345678u);
  EXPECT_EQ(rotate_left(0x12, 8, 8), 0x12u);
}

// The C library's rounding (to nearest, ties to even) is the oracle.
TEST(Arithmetic, RoundToEven_WhenComparedWithTheLibrary_ThenAgrees) {
  ASSERT_EQ(std::fegetround(), FE_TONEAREST);
  const double samples[] = {
      0.5,   1.5,    2.5, -0.5, -1.5, -2.5, 0.49999999999999994, 4503599627370495.5, 4503599627370496.0,
      1e300, -1e300, 0.0};
  for (const double x : samples) EXPECT_EQ(round_to_even(x), std::nearbyint(x)) << x;
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())),
                                -static_cast<int>(random() % 64));
    ASSERT_EQ(round_to_even(x), std::nearbyint(x)) << x;
    ASSERT_EQ(truncate(x), std::trunc(x)) << x;
  }
}

TEST(Arithmetic, ToInteger_WhenAtTheEdgesOfARange_ThenAcceptsExactlyTheRange) {
  std::uint64_t slot = 0;
  EXPECT_TRUE(to_integer(127, IntType::I8, slot));
  EXPECT_FALSE(to_integer(128, IntType::I8, slot));
  EXPECT_TRUE(to_integer(-128, IntType::I8, slot));
  EXPECT_EQ(slot, 0xFFFFFF80u);
  EXPECT_FALSE(to_integer(-1, IntType::U16, slot));
  EXPECT_TRUE(to_integer(4294967295.0, IntType::U32, slot));
  EXPECT_EQ(slot, 0xFFFFFFFFu);
  EXPECT_FALSE(to_integer(4294967296.0, IntType::U32, slot));
  EXPECT_TRUE(to_integer(-9223372036854775808.0, IntType::I64, slot));
  EXPECT_FALSE(to_integer(9223372036854775808.0, IntType::I64, slot));
  EXPECT_TRUE(to_integer(9223372036854775808.0, IntType::U64, slot));
  EXPECT_EQ(slot, 0x8000000000000000u);
  EXPECT_FALSE(to_integer(std::numeric_limits<double>::quiet_NaN(), IntType::I32, slot));
  EXPECT_FALSE(to_integer(std::numeric_limits<double>::infinity(), IntType::U64, slot));
}

}  // namespace
}  // namespace stepwright::operations
