#include "runtime/ground/naming/ascii_names.h"

#include <gtest/gtest.h>

namespace stepwright::naming {
namespace {

TEST(AsciiNames, WhenOnlyTheCaseDiffers_ThenTheNamesAreTheSame) {
  EXPECT_TRUE(same_name("Drive_Left", "drive_LEFT"));
  EXPECT_TRUE(same_name("", ""));
  EXPECT_FALSE(same_name("B1", "B2"));
  EXPECT_FALSE(same_name("B1", "B"));
  EXPECT_FALSE(same_name("", "B"));
}

TEST(AsciiNames, WhenACharacterIsNoLetter_ThenItHasNoCase) {
  EXPECT_FALSE(same_name("[", "{"));
  EXPECT_FALSE(same_name("@", "`"));
  EXPECT_EQ(to_upper('{'), '{');
  EXPECT_EQ(to_lower('['), '[');
  EXPECT_EQ(to_upper('\xE4'), '\xE4');
}

TEST(AsciiNames, WhenACharacterIsALetter_ThenItHasBothCases) {
  EXPECT_EQ(to_upper('a'), 'A');
  EXPECT_EQ(to_upper('z'), 'Z');
  EXPECT_EQ(to_lower('A'), 'a');
  EXPECT_EQ(to_lower('Z'), 'z');
}

}  // namespace
}  // namespace stepwright::naming
