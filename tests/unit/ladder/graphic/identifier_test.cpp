#include "ladder/graphic/identifier.h"

#include <gtest/gtest.h>

namespace stepwright::graphic {
namespace {

TEST(Identifier, WhenNameFollowsTheStandard_ThenItIsLegal) {
  for (const char* name : {"a", "_a", "S01_LOAD", "x1_y2"}) EXPECT_TRUE(is_identifier(name)) << name;
  for (const char* name : {"", "1a", "a__b", "a_", "a b", "a.b", "ä", "_", "a-b"}) {
    EXPECT_FALSE(is_identifier(name)) << name;
  }
}

TEST(Identifier, WhenWordIsReserved_ThenItIsAKeywordInAnyCase) {
  for (const char* word : {"IF", "end_if", "Bool", "XOR", "ABSTRACT", "VAR_EXTERNAL", "STEP"}) {
    EXPECT_TRUE(is_keyword(word)) << word;
  }
  for (const char* word : {"TON", "STEPS", "", "I", "IF THEN"}) EXPECT_FALSE(is_keyword(word)) << word;
}

TEST(Identifier, WhenTextIsNoName_ThenTheNearestNameIsMade) {
  EXPECT_EQ(make_identifier("motor.run[2]"), "motor_run_2");
  EXPECT_EQ(make_identifier("7up"), "N7up");
  EXPECT_EQ(make_identifier("%QX0.0"), "QX0_0");
  EXPECT_EQ(make_identifier("..."), "N");
  EXPECT_EQ(make_identifier("if"), "if_1");
}

TEST(NameSet, WhenNameIsTaken_ThenTheNextFreeOneIsGiven) {
  NameSet names;
  EXPECT_TRUE(names.insert("Pump"));
  EXPECT_FALSE(names.insert("PUMP"));
  EXPECT_EQ(names.unique("pump"), "pump_2");
  EXPECT_EQ(names.unique("pump"), "pump_3");
  EXPECT_TRUE(names.contains("Pump_3"));
}

}  // namespace
}  // namespace stepwright::graphic
