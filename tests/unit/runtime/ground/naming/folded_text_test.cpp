#include "runtime/ground/naming/folded_text.h"

#include <gtest/gtest.h>

namespace stepwright::naming {
namespace {

TEST(FoldedText, WhenLettersHaveACase_ThenItIsTheLowerOne) {
  EXPECT_EQ(folded("Tank 2 FULL"), "tank 2 full");
  EXPECT_EQ(folded("ÜBERLAUF der Füllstraße"), "überlauf der füllstraße");
  EXPECT_EQ(folded("ÉCHAUFFEMENT, ÑU, ŽLUTÝ, ДВИГАТЕЛЬ, ΑΝΤΛΊΑ"),
            "échauffement, ñu, žlutý, двигатель, αντλία");
  EXPECT_EQ(folded("温度 10 °C"), "温度 10 °c");
  EXPECT_EQ(folded(""), "");
}

TEST(FoldedText, WhenBytesAreNoUtf8_ThenTheyStay) {
  EXPECT_EQ(folded("\xC4\xFF Ä"), "\xC4\xFF ä");
  EXPECT_EQ(folded("A\xE2\x82"), "a\xE2\x82");
  EXPECT_EQ(folded(std::string_view("Ä\0B", 4)), std::string_view("ä\0b", 4));
}

}  // namespace
}  // namespace stepwright::naming
