#include "ladder/graphic/literal_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace stepwright::graphic {
namespace {

TEST(RealLiteral, WhenANumberIsWritten_ThenItHasAPointAndNoSignOfZero) {
  EXPECT_EQ(real_literal(1.25), "1.25");
  EXPECT_EQ(real_literal(-2.0), "-2.0");
  EXPECT_EQ(real_literal(0.0), "0.0");
  EXPECT_EQ(real_literal(-0.0), "0.0");
  EXPECT_EQ(real_literal(-0.0, 7), "0.0");
  EXPECT_EQ(real_literal(1e-5), "1.0e-05");
  EXPECT_EQ(real_literal(1.5e300), "1.5e+300");
  EXPECT_EQ(real_literal(1.0 / 3.0, 7), "0.3333333");
  EXPECT_EQ(real_literal(1e9, 7), "1.0e+09");
  EXPECT_EQ(real_literal(100.0, 9), "100.0");
}

TEST(RealLiteral, WhenItIsRead_ThenItIsTheSameNumber) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-290.0, 290.0);
  for (int k = 0; k < 2'000; ++k) {
    const double value = std::pow(10.0, exponent(random)) * (random() % 2 == 0 ? 1.0 : -1.0);
    const std::string text = real_literal(value);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    EXPECT_NE(text.find('.'), std::string::npos) << text;
    EXPECT_EQ(std::strtod(real_literal(value, 17).c_str(), nullptr), value);
  }
}

}  // namespace
}  // namespace stepwright::graphic
