#include "firmware/decimal/characters.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

// The C++ library of the host is the oracle: every character and every bit must be equal.

namespace stepwright::decimal {
namespace {

template <typename Float>
std::string expected_text(Float value, std::chars_format format) {
  char text[128];
  return {text, std::to_chars(text, text + sizeof text, value, format).ptr};
}

template <typename Float>
std::string own_text(Float value, std::chars_format format) {
  char text[128];
  return {text, to_characters(text, text + sizeof text, value, format).ptr};
}

template <typename Float>
void expect_same_reading(const std::string& text) {
  Float expected = 0;
  Float own = 0;
  const char* const end = text.data() + text.size();
  const auto by_library = std::from_chars(text.data(), end, expected);
  const auto by_us = from_characters(text.data(), end, own);
  ASSERT_EQ(by_us.ec, by_library.ec) << text;
  ASSERT_EQ(by_us.ptr, by_library.ptr) << text;
  ASSERT_TRUE(expected == own && std::signbit(expected) == std::signbit(own)) << text;
}

template <typename Float>
void expect_same(Float value) {
  if (!std::isfinite(value)) return;
  const Float magnitude = std::abs(value);
  const bool plain = magnitude == 0 || (magnitude >= Float(1e-5) && magnitude < Float(1e15));
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  const std::string text = expected_text(value, format);
  ASSERT_EQ(own_text(value, format), text);
  expect_same_reading<Float>(text);
}

template <typename Float>
class CharactersTest : public testing::Test {};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(CharactersTest, Floats);

TYPED_TEST(CharactersTest, Characters_WhenBitsAreRandom_ThenAreThoseOfTheLibrary) {
  using Bits = std::conditional_t<sizeof(TypeParam) == 4, std::uint32_t, std::uint64_t>;
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    auto bits = static_cast<Bits>(random());
    if (i % 3 == 0) bits &= ~Bits{0xFFFFF};  // few digits: neighbours at uneven distances, too
    ASSERT_NO_FATAL_FAILURE(expect_same(std::bit_cast<TypeParam>(bits)));
  }
}

TYPED_TEST(CharactersTest, Characters_WhenNumbersAreThoseOfPeople_ThenAreThoseOfTheLibrary) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto whole = static_cast<double>(random() % 1'000'000'000'000'000);
    ASSERT_NO_FATAL_FAILURE(
        expect_same(static_cast<TypeParam>(std::ldexp(whole, -static_cast<int>(random() % 60)))));
    ASSERT_NO_FATAL_FAILURE(
        expect_same(static_cast<TypeParam>(static_cast<double>(random() % 100'000) / 1000)));
  }
}

TYPED_TEST(CharactersTest, Characters_WhenAtTheEdgesOfTheFormat_ThenAreThoseOfTheLibrary) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam value :
       {TypeParam(0), -TypeParam(0), Limits::denorm_min(), Limits::min(), Limits::max(), Limits::lowest(),
        std::nextafter(Limits::min(), TypeParam(0)), TypeParam(1e15), TypeParam(1e-5), TypeParam(1)}) {
    ASSERT_NO_FATAL_FAILURE(expect_same(value));
    ASSERT_NO_FATAL_FAILURE(expect_same(std::nextafter(value, TypeParam(1))));
  }
}

TYPED_TEST(CharactersTest, Reading_WhenLiteralsAreLong_ThenIsThatOfTheLibrary) {
  std::mt19937_64 random(3);
  const auto digits = [&](std::uint64_t count) {
    std::string text;
    for (std::uint64_t i = 0; i < count; ++i) text += static_cast<char>('0' + random() % 10);
    return text;
  };
  for (int i = 0; i < 20'000; ++i) {
    std::string text = random() % 2 == 0 ? "-" : "";
    text += digits(1 + random() % (i % 10 == 0 ? 200 : 20));
    if (random() % 2 == 0) text += "." + digits(1 + random() % 20);
    if (random() % 2 == 0) text += (random() % 2 == 0 ? "e-" : "e") + std::to_string(random() % 340);
    ASSERT_NO_FATAL_FAILURE(expect_same_reading<TypeParam>(text));
  }
}

TYPED_TEST(CharactersTest, Reading_WhenHalfwayBetweenTwoNumbers_ThenTakesTheEvenOne) {
  for (const char* text : {"9007199254740993", "9007199254740995", "16777217", "16777219",
                           "2.4703282292062327208e-324", "2.4703282292062328e-324", "7.0064923216240854e-46",
                           "1e400", "1e-400", "1e99999999999", "0e99999999999", "1.7976931348623159e308"}) {
    ASSERT_NO_FATAL_FAILURE(expect_same_reading<TypeParam>(text));
  }
}

}  // namespace
}  // namespace stepwright::decimal
