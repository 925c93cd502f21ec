#include "supervisor/tamp/mission/order.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/tamp/mission/arms_cell.h"

namespace stepwright::tamp::mission {
namespace {

std::string code_of(const std::string& goal) {
  const auto order = read_order(testing::paper_cell(), "x", goal, "test");
  return order ? std::string() : order.error().front().code;
}

TEST(ArmsOrder, WhenAGoalIsRead_ThenThingsAndRegionsAreThoseOfTheCell) {
  const scene::RobotCell& cell = testing::paper_cell();
  const auto order = read_order(cell, "P1", "(and (in cup1 red-region))", "test");
  ASSERT_TRUE(order) << result::to_string(order.error());
  ASSERT_EQ(order->wanted.size(), 1u);
  EXPECT_EQ(order->wanted[0], (Wanted{cell.thing("cup1"), cell.surface("red-region"), -1}));
  EXPECT_EQ(text_of(cell, order->wanted[0]), "cup1 in red-region");
}

TEST(ArmsOrder, WhenAGoalMeansNothing_ThenThatIsToldAtItsPlace) {
  EXPECT_EQ(code_of("(in cup1 red-region)"), "");
  EXPECT_EQ(code_of("(in cup2 red-region)"), "G0401");
  EXPECT_EQ(code_of("(in cup1 nowhere)"), "G0401");
  EXPECT_EQ(code_of("(in cup1 cup1)"), "G0401");
  EXPECT_EQ(code_of("(on cup1 red-region)"), "G0401");
  EXPECT_EQ(code_of("(and)"), "G0401");
  EXPECT_EQ(code_of("(and (in cup1 table) (in cup1 box-top))"), "G0401");
  EXPECT_NE(code_of("(in cup1 red-region"), "");
  EXPECT_NE(code_of("(in cup1 red-region) (in"), "");
  const auto wrong = read_order(testing::paper_cell(), "x", "(in cup2 red-region)", "cell.toml");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().front().where.file, "cell.toml");
  EXPECT_EQ(wrong.error().front().where.column, 5u);
}

TEST(ArmsOrder, WhenAThingStandsInItsRegion_ThenItIsMetAndTheProblemSaysSo) {
  const scene::RobotCell& cell = testing::paper_cell();
  const auto order = read_order(cell, "P1", "(in cup1 red-region)", "test");
  ASSERT_TRUE(order);
  scene::GeometricState state = initial_state(cell);
  EXPECT_EQ(not_yet(cell, state, *order), "cup1 in red-region");
  EXPECT_NE(problem_text(cell, *order, state, nullptr).find("(in cup1 table)"), std::string::npos);
  state.things[0].pose = {0.45, 0.5, 0.701, 0.3};
  EXPECT_EQ(not_yet(cell, state, *order), "");
  EXPECT_NE(problem_text(cell, *order, state, nullptr).find("(in cup1 red-region)"), std::string::npos);
  state.things[0].pose.y_m = 0.58;
  EXPECT_EQ(not_yet(cell, state, *order), "cup1 in red-region") << "it stands over the edge";
  state.things[0].pose.y_m = 0.5;
  state.things[0].holder = 0;
  EXPECT_EQ(not_yet(cell, state, *order), "cup1 in red-region") << "a hand holds it";
}

}  // namespace
}  // namespace stepwright::tamp::mission
