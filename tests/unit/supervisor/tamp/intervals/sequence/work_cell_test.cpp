#include "supervisor/tamp/intervals/sequence/work_cell.h"

#include <gtest/gtest.h>

#include <limits>

#include "supervisor/tamp/intervals/reach/column_arm.h"

namespace stepwright::tamp {
namespace {

WorkCell small_cell(const ReachBounds& reach) {
  WorkCell cell;
  cell.arms = {{"right", &reach}, {"left", &reach}};
  cell.grasps = {{"top", 0.34, 0.0, {}}};
  cell.regions = {{"tray1", 0.5, 0.0, 0.1, 0.3, 0.3, 0.0}};
  cell.objects = {{"cup1", {0.5, 0.2, 0.1, 0.0}, 0.1}, {"cup2", {0.5, -0.2, 0.1, 0.0}, 0.1}};
  return cell;
}

std::string codes(const result::Result<void>& judged) {
  std::string all;
  if (!judged)
    for (const auto& each : judged.error()) all += (all.empty() ? "" : " ") + each.code;
  return all;
}

TEST(WorkCell, WhenAnActionCannotFollow_ThenItIsRefusedByNumber) {
  const ReachTable reach = reach_table({}, 0.1);
  const WorkCell cell = small_cell(reach);
  const auto judge = [&](std::vector<Action> sequence) { return codes(validate(cell, sequence)); };
  EXPECT_EQ(judge({pick(0, 0), place(0, 0, 0), pick(1, 1), stack(1, 1, 0)}), "");
  EXPECT_EQ(judge({place(0, 0, 0)}), "I0102") << "not held";
  EXPECT_EQ(judge({pick(0, 0), pick(1, 0)}), "I0102") << "held twice";
  EXPECT_EQ(judge({pick(0, 0), pick(0, 1)}), "I0102") << "a full hand";
  EXPECT_EQ(judge({pick(0, 0), place(1, 0, 0)}), "I0102") << "the other hand";
  EXPECT_EQ(judge({pick(0, 0), stack(0, 0, 0)}), "I0102") << "on itself";
  EXPECT_EQ(judge({pick(0, 0), pick(1, 1), stack(0, 0, 1)}), "I0102") << "on what is held";
  EXPECT_EQ(judge({pick(0, 0), stack(0, 0, 1), pick(1, 1)}), "I0102") << "from below";
  EXPECT_EQ(judge({pick(0, 7)}), "I0103");
  EXPECT_EQ(judge({pick(0, 0), place(0, 0, 9)}), "I0103");
  EXPECT_EQ(judge({pick(0, 0), place(0, 0, 0, std::numeric_limits<double>::quiet_NaN())}), "I0101");
  const auto judged = validate(cell, std::vector{pick(0, 0), place(1, 0, 0)}, "cell.toml");
  EXPECT_EQ(result::to_string(judged.error()), "cell.toml: I0102: action 2: arm 'left' does not hold 'cup1'");
}

TEST(WorkCell, WhenNumbersAreNone_ThenAllOfThemAreNamed) {
  const ReachTable reach = reach_table({}, 0.1);
  WorkCell cell = small_cell(reach);
  cell.grasps[0].height_m = 500.0;
  cell.regions[0].x_m = std::numeric_limits<double>::infinity();
  cell.objects[1].start.angle_rad = std::numeric_limits<double>::quiet_NaN();
  cell.arms[1].reach = nullptr;
  EXPECT_EQ(codes(validate(cell, {})), "I0103 I0101 I0101 I0101");
}

TEST(WorkCell, WhenActionsAreTold_ThenByTheirNames) {
  const ReachTable reach = reach_table({}, 0.1);
  const WorkCell cell = small_cell(reach);
  EXPECT_EQ(text_of(cell, pick(0, 0)), "right picks cup1");
  EXPECT_EQ(text_of(cell, place(0, 0, 0)), "right places cup1 on tray1");
  EXPECT_EQ(text_of(cell, stack(1, 1, 0)), "left places cup2 on cup1");
  EXPECT_EQ(text_of(cell, move_away(1)), "left moves away");
}

}  // namespace
}  // namespace stepwright::tamp
