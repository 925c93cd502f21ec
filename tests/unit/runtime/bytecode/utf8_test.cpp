#include "runtime/bytecode/utf8.h"

#include <gtest/gtest.h>

#include <string_view>

namespace stepwright::bytecode {
namespace {

bool valid(std::string_view text) {
  return is_utf8({text.data(), text.size()});
}

TEST(Utf8, Text_WhenWellFormed_ThenIsAccepted) {
  EXPECT_TRUE(valid(""));
  EXPECT_TRUE(valid("MAIN.level"));
  EXPECT_TRUE(valid("F\xC3\xBCllstand \xE2\x82\xAC \xF0\x9F\x8F\xAD"));
}

TEST(Utf8, Text_WhenMalformed_ThenIsRefused) {
  EXPECT_FALSE(valid("\x80"));
  EXPECT_FALSE(valid("a\xC3"));
  EXPECT_FALSE(valid("\xC0\xAF"));
  EXPECT_FALSE(valid("\xE0\x80\xAF"));
  EXPECT_FALSE(valid("\xED\xA0\x80"));
  EXPECT_FALSE(valid("\xF4\x90\x80\x80"));
  EXPECT_FALSE(valid("\xF5\x80\x80\x80"));
  EXPECT_FALSE(valid("\xE2\x28\xA1"));
}

}  // namespace
}  // namespace stepwright::bytecode
