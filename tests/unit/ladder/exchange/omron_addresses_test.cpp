#include "ladder/exchange/omron_addresses.h"

#include <gtest/gtest.h>

namespace stepwright::exchange {
namespace {

TEST(OmronAddress, WhenItIsOneOfACj_ThenCodeAndShownFormAreKnown) {
  const auto code = [](const char* text) { return parse_omron_address(text).value().code; };
  const auto shown = [](const char* text) { return parse_omron_address(text).value().shown; };
  EXPECT_EQ(code("I0.00"), "0.00");
  EXPECT_EQ(code("q:1.05"), "1.05");
  EXPECT_EQ(shown("Q1.05"), "Q:1.05");
  EXPECT_EQ(shown("I: 0.00"), "I:0.00");
  EXPECT_EQ(code("W10.15"), "W10.15");
  EXPECT_EQ(code("D100"), "D100");
  EXPECT_EQ(code("I2001"), "2001");
  EXPECT_TRUE(parse_omron_address("I0.00")->is_input);
  EXPECT_FALSE(parse_omron_address("1.00")->is_input);
}

TEST(OmronAddress, WhenItIsNone_ThenItIsRefused) {
  for (const char* text : {"", "W", "W10.16", "W10.1", "W512.00", "D32768", "D1.00", "X1.00", "%IX0.0",
                           "1.00.00", "W-1.00", "99999999999.00", "W10."}) {
    EXPECT_FALSE(parse_omron_address(text)) << text;
  }
}

TEST(TimeLiteral, WhenPartsAreGiven_ThenTheyAddUp) {
  EXPECT_EQ(time_literal_ns("T#2s"), 2'000'000'000);
  EXPECT_EQ(time_literal_ns("time#1m_30s"), 90'000'000'000);
  EXPECT_EQ(time_literal_ns("T#1.5s"), 1'500'000'000);
  EXPECT_EQ(time_literal_ns("T#10ms"), 10'000'000);
  for (const char* text : {"T#", "2s", "T#s", "T#5", "T#1x", "X#1s", "t1", "T#1.2.3s", "T#.s"}) {
    EXPECT_FALSE(time_literal_ns(text)) << text;
  }
}

}  // namespace
}  // namespace stepwright::exchange
