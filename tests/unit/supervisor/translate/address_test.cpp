#include "supervisor/translate/address.h"

#include <gtest/gtest.h>

namespace stepwright::translate {
namespace {

TEST(ParseAddress, WhenBitOrWord_ThenCountsBitsFromTheArea) {
  const auto bit = parse_address("%IX2.5");
  ASSERT_TRUE(bit);
  EXPECT_EQ(bit->area, 'I');
  EXPECT_EQ(bit->first_bit, 21U);
  EXPECT_EQ(bit->bits, 1U);
  const auto word = parse_address("%QW3");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->first_bit, 48U);
  EXPECT_EQ(word->bits, 16U);
  EXPECT_EQ(parse_address("%M0.1")->first_bit, 1U);
  EXPECT_EQ(parse_address("%IX21")->first_bit, 21U);
}

TEST(ParseAddress, WhenMalformed_ThenRefuses) {
  for (const char* text : {"", "%", "%I", "IX0.0", "%IX0.8", "%IX0.", "%IXx.1", "%IW", "%IW1.2", "%ZX0.0",
                           "%IX70000.0", "%IL9000", "%IW-1", "%IX0.0 ", "%IX 0.0"}) {
    EXPECT_FALSE(parse_address(text)) << text;
  }
}

TEST(Overlap, WhenWordCoversBytes_ThenItsBitsOverlap) {
  const auto word = *parse_address("%IW1");  // bytes 2 and 3
  EXPECT_TRUE(overlap(word, *parse_address("%IX3.7")));
  EXPECT_TRUE(overlap(word, *parse_address("%IB2")));
  EXPECT_TRUE(overlap(word, *parse_address("%ID0")));
  EXPECT_FALSE(overlap(word, *parse_address("%IX1.7")));
  EXPECT_FALSE(overlap(word, *parse_address("%IX4.0")));
  EXPECT_FALSE(overlap(word, *parse_address("%QW1")));
}

}  // namespace
}  // namespace stepwright::translate
