#include "supervisor/tamp/mission/sight.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/tamp/mission/arms_cell.h"

namespace stepwright::tamp::mission {
namespace {

constexpr int kCup = 1, kCan = 2;

scene::RobotCell two_cups() {
  scene::RobotCell cell = testing::paper_cell();
  scene::Thing other = cell.things[0];
  other.name = "cup2";
  other.start.x_m += 0.2;
  cell.things.push_back(other);
  return cell;
}

std::vector<scene::Pose> starts(const scene::RobotCell& cell) {
  std::vector<scene::Pose> poses;
  for (const scene::Thing& each : cell.things) poses.push_back(each.start);
  return poses;
}

TEST(ArmsSight, WhenMostReportsAgree_ThenTheMeanIsBelievedAndGhostsAreNot) {
  const scene::RobotCell cell = two_cups();
  const scene::Pose a = cell.things[0].start, b = cell.things[1].start;
  std::vector<Report> reports;
  for (int k = 0; k < 5; ++k) {
    Report report;
    const double off_m = 0.001 * (k - 2);
    if (k != 3) report.push_back({kCup, {b.x_m + off_m, b.y_m, b.z_m, 0.0}});
    if (k != 1) report.push_back({kCup, {a.x_m, a.y_m + off_m, a.z_m, 0.0}});
    if (k == 2) report.push_back({kCup, {0.6, 0.3, 0.7, 0.0}});
    reports.push_back(report);
  }
  const Sight sight = agree(cell, reports, starts(cell));
  ASSERT_TRUE(sight.things[0] && sight.things[1]);
  EXPECT_NEAR(sight.things[0]->y_m, a.y_m, 0.001);
  EXPECT_NEAR(sight.things[1]->x_m, b.x_m, 0.001);
  EXPECT_TRUE(sight.strangers.empty());
}

TEST(ArmsSight, WhenAThingIsNotInMostReports_ThenNothingIsBelievedOfIt) {
  const scene::RobotCell cell = two_cups();
  const scene::Pose a = cell.things[0].start, b = cell.things[1].start;
  std::vector<Report> reports(5, Report{{kCup, a}});
  reports[0].push_back({kCup, b});
  scene::Pose elsewhere = b;
  elsewhere.x_m += 0.1;
  reports[3].push_back({kCup, elsewhere});
  reports[4].push_back({kCup, elsewhere});
  const Sight sight = agree(cell, reports, starts(cell));
  EXPECT_TRUE(sight.things[0]);
  EXPECT_FALSE(sight.things[1]);
  reports[4].push_back({kCup, b});
  EXPECT_TRUE(agree(cell, reports, starts(cell)).things[1]) << "two have it where it stood";
}

TEST(ArmsSight, WhenAThingIsMovedWhileItIsLookedAt_ThenItIsNotBelievedWhereItWas) {
  const scene::RobotCell cell = two_cups();
  scene::Pose moved = cell.things[1].start;
  moved.y_m += 0.035;
  for (const std::size_t since : {1U, 2U, 3U}) {
    std::vector<Report> reports(5, Report{{kCup, cell.things[0].start}});
    for (std::size_t k = 0; k < reports.size(); ++k)
      reports[k].push_back({kCup, k < since ? cell.things[1].start : moved});
    const Sight sight = agree(cell, reports, starts(cell));
    ASSERT_TRUE(sight.things[0]);
    EXPECT_EQ(sight.things[1].has_value(), since < 3) << "most reports have it by then";
    if (sight.things[1].has_value()) {
      EXPECT_DOUBLE_EQ(sight.things[1]->y_m, moved.y_m);
    }
    EXPECT_TRUE(sight.strangers.empty());
  }
  std::vector<Report> reports(5, Report{{kCup, cell.things[0].start}, {kCup, cell.things[1].start}});
  reports[4].back().pose = moved;
  EXPECT_DOUBLE_EQ(agree(cell, reports, starts(cell)).things[1]->y_m, cell.things[1].start.y_m)
      << "one report alone may be of what is not there";
}

TEST(ArmsSight, WhenOneIsNotSeenFromThenOnAsAnotherIsSeen_ThenNothingHasMoved) {
  const scene::RobotCell cell = two_cups();
  std::vector<Report> reports(5);
  for (std::size_t k = 0; k < reports.size(); ++k)
    reports[k].push_back({kCup, cell.things[k < 3 ? 0 : 1].start});
  const Sight sight = agree(cell, reports, starts(cell));
  EXPECT_TRUE(sight.things[0] && sight.things[1]);
}

TEST(ArmsSight, WhenThereIsMoreThanTheCellHas_ThenItIsAStranger) {
  const scene::RobotCell& cell = testing::paper_cell();
  const std::vector<Report> reports(
      5, Report{{kCup, {0.6, 0.2, 0.7, 0.0}}, {kCup, cell.things[0].start}, {kCan, {0.7, 0.2, 0.7, 0.0}}});
  const Sight sight = agree(cell, reports, starts(cell));
  ASSERT_TRUE(sight.things[0]);
  EXPECT_NEAR(sight.things[0]->y_m, cell.things[0].start.y_m, 1e-9);
  EXPECT_EQ(sight.strangers.size(), 2u);
}

TEST(ArmsSight, WhenAThingIsSeenOnSomething_ThenItsHeightIsThatOfWhatItStandsOn) {
  const scene::RobotCell& cell = testing::paper_cell();
  Sight sight;
  sight.things.resize(1);
  EXPECT_DOUBLE_EQ(settled(cell, sight, 0, {0.45, 0.0, 0.853, 0.0}).z_m, 0.85);
  EXPECT_DOUBLE_EQ(settled(cell, sight, 0, {0.5, -0.4, 0.694, 0.0}).z_m, 0.7);
  EXPECT_DOUBLE_EQ(settled(cell, sight, 0, {0.5, -0.4, 0.78, 0.0}).z_m, 0.78) << "it hangs in a hand";
}

}  // namespace
}  // namespace stepwright::tamp::mission
