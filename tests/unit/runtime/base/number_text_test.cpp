#include "runtime/base/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace stepwright::base {
namespace {

std::string str(const ShortText& text) {
  return {text.view().begin(), text.view().end()};
}

template <typename T>
bool reads(const std::string& text, T expected) {
  T value{};
  return parse(std::span(text), value) && value == expected;
}

template <typename T>
bool refuses(const std::string& text) {
  T value = T{7};
  return !parse(std::span(text), value) && value == T{7};
}

TEST(NumberText, Integers_WhenWritten_ThenAreDecimal) {
  EXPECT_EQ(str(text_of(std::int64_t{0})), "0");
  EXPECT_EQ(str(text_of(std::numeric_limits<std::int64_t>::min())), "-9223372036854775808");
  EXPECT_EQ(str(text_of(std::numeric_limits<std::uint64_t>::max())), "18446744073709551615");
}

TEST(NumberText, Reals_WhenWritten_ThenAreTheShortestLiterals) {
  EXPECT_EQ(str(text_of(0.1f)), "0.1");
  EXPECT_EQ(str(text_of(0.1)), "0.1");
  EXPECT_EQ(str(text_of(-0.0)), "-0.0");
  EXPECT_EQ(str(text_of(100000.0)), "100000.0");
  EXPECT_EQ(str(text_of(16777216.0f)), "16777216.0");
  EXPECT_EQ(str(text_of(1e20)), "1.0E+20");
  EXPECT_EQ(str(text_of(1.5e-7f)), "1.5E-07");
  EXPECT_EQ(str(text_of(std::numeric_limits<double>::infinity())), "Infinity");
  EXPECT_EQ(str(text_of(-std::numeric_limits<float>::infinity())), "-Infinity");
  EXPECT_EQ(str(text_of(std::numeric_limits<double>::quiet_NaN())), "NaN");
}

TEST(NumberText, Reals_WhenWrittenAndRead_ThenEveryBitComesBack) {
  std::mt19937_64 random(31);
  for (int i = 0; i < 50'000; ++i) {
    const auto wide = std::bit_cast<double>(random());
    const auto narrow = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isfinite(wide)) {
      ASSERT_TRUE(reads(str(text_of(wide)), wide)) << str(text_of(wide));
    }
    if (std::isfinite(narrow)) {
      ASSERT_TRUE(reads(str(text_of(narrow)), narrow)) << str(text_of(narrow));
    }
  }
}

TEST(NumberText, IntegerLiterals_WhenRead_ThenGiveTheirValue) {
  EXPECT_TRUE(reads("1_000", std::int64_t{1000}));
  EXPECT_TRUE(reads("+5", std::int64_t{5}));
  EXPECT_TRUE(reads("16#fF", std::int64_t{255}));
  EXPECT_TRUE(reads("2#1010", std::uint64_t{10}));
  EXPECT_TRUE(reads("-8#17", std::int64_t{-15}));
  EXPECT_TRUE(reads("-9223372036854775808", std::numeric_limits<std::int64_t>::min()));
  EXPECT_TRUE(reads("18446744073709551615", std::numeric_limits<std::uint64_t>::max()));
}

TEST(NumberText, TextsThatAreNoIntegers_WhenRead_ThenAreRefused) {
  for (const char* text : {"", " 1", "1 ", "1.0", "--1", "1__0", "_1", "1_", "16#", "16#G", "8#8", "INT#5",
                           "9223372036854775808", "18446744073709551616"}) {
    EXPECT_TRUE(refuses<std::int64_t>(text)) << text;
  }
  EXPECT_TRUE(refuses<std::uint64_t>("-1"));
}

TEST(NumberText, RealLiterals_WhenRead_ThenGiveTheNearestNumber) {
  EXPECT_TRUE(reads("1_0.2_5", 10.25));
  EXPECT_TRUE(reads("-3", -3.0));
  EXPECT_TRUE(reads("+1.0E+3", 1000.0));
  EXPECT_TRUE(reads("1e-3", 0.001f));
  EXPECT_TRUE(reads("0.1", 0.1f));
}

TEST(NumberText, TextsThatAreNoReals_WhenRead_ThenAreRefused) {
  for (const char* text :
       {"", ".5", "5.", "1.e5", "1e", "inf", "nan", "0x1p3", "1.5.2", "1E400", "NaN", "1,5"}) {
    EXPECT_TRUE(refuses<double>(text)) << text;
  }
  EXPECT_TRUE(refuses<float>("1E39"));
  EXPECT_TRUE(refuses<double>(std::string(256, '1')));
}

TEST(NumberText, Booleans_WhenRead_ThenOnlyTheirWordsAreTaken) {
  EXPECT_TRUE(reads("TRUE", true));
  EXPECT_TRUE(reads("false", false));
  EXPECT_TRUE(reads("1", true));
  EXPECT_TRUE(reads("0", false));
  bool value = true;
  for (const std::string text : {"", "2", "TRUE ", "YES", "10"})
    EXPECT_FALSE(parse(std::span(text), value)) << text;
  EXPECT_TRUE(value);
}

}  // namespace
}  // namespace stepwright::base
