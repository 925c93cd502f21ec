#include "supervisor/ltl/trace/binding.h"

#include <gtest/gtest.h>

namespace stepwright::ltl {
namespace {

TEST(Binding, Text_WhenItIsAColumnOrAComparison_ThenRead) {
  const auto plain = read_binding(" go = MAIN.run ");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->proposition, "go");
  EXPECT_EQ(plain->column, "MAIN.run");
  EXPECT_EQ(plain->relation, Relation::Holds);
  EXPECT_EQ(read_binding("go=!MAIN.stop")->relation, Relation::HoldsNot);
  EXPECT_EQ(read_binding("go=!MAIN.stop")->column, "MAIN.stop");
  const auto level = read_binding("full=MAIN.level>=2.5");
  ASSERT_TRUE(level);
  EXPECT_EQ(level->column, "MAIN.level");
  EXPECT_EQ(level->relation, Relation::GreaterEqual);
  EXPECT_EQ(level->value, "2.5");
  EXPECT_EQ(read_binding("idle=MAIN.mode = Idle")->value, "Idle");
  EXPECT_EQ(read_binding("busy=MAIN.mode<>Idle")->relation, Relation::Unequal);
}

TEST(Binding, Text_WhenItSaysNothing_ThenRefused) {
  for (const char* text : {"", "a", "a=", "=b", "a=b>", "a=>3", "a=!", "=>"}) {
    const auto read = read_binding(text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().front().code, "L0043");
    EXPECT_FALSE(read.error().front().hint.empty());
  }
}

}  // namespace
}  // namespace stepwright::ltl
