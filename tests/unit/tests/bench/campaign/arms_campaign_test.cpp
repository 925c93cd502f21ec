// A short campaign of two arms in every test run: each kind of disturbance, and every seed that was ever
// lost.

#include <gtest/gtest.h>

#include "tests/bench/campaign/arms.h"

namespace stepwright::campaign {
namespace {

TEST(ArmsCampaign, WhenDisturbedAtRandom_ThenNoRunIsLost) {
  const ArmsFigures figures = arms_campaign(0, 8, 1);
  const ArmsClass& all = figures.of.at("all");
  EXPECT_EQ(all.runs, 8u);
  EXPECT_EQ(all.lost, 0u) << table(figures);
  EXPECT_EQ(figures.of.size(), 9u) << "each kind once, and their sum";
  EXPECT_EQ(figures.of.at("none").goals, 1u) << table(figures);
  EXPECT_EQ(figures.of.at("none").replans, 0u) << table(figures);
  EXPECT_EQ(figures.of.at("trip").safe_stops, 1u) << table(figures);
}

// What a camera sees that is not there is no reason to stop. Such a run was lost besides, by what an earlier
// program had left of an arm that had nothing to do in the next one.
TEST(ArmsCampaign, WhenTheCameraSeesGhosts_ThenNothingCountsAsMoved) {
  const ArmsRun run = run_arms(6);
  EXPECT_EQ(run.kind, "camera");
  EXPECT_EQ(run.verdict, Verdict::GoalReached) << run.story << ": " << run.why;
  EXPECT_TRUE(run.record.replans.empty()) << run.record.replans.front().cause;
}

// Each of them was lost while a joint could stay far behind its set point: the hand closed beside a can (60,
// 108), an arm touched a cup on its way (84, 92, 196, 268, 284), or a plan ended elsewhere than where it
// should (28, 252).
TEST(ArmsCampaign, WhenAJointSticks_ThenTheRunEndsWithThatJointBeforeAnythingIsTouched) {
  for (const std::uint64_t seed : {28U, 60U, 84U, 92U, 108U, 196U, 252U, 268U, 284U}) {
    const ArmsRun run = run_arms(seed);
    EXPECT_EQ(run.kind, "stuck");
    EXPECT_EQ(run.verdict, Verdict::SafeStop) << run.story << ": " << run.why;
    EXPECT_NE(run.record.message.find("it is stuck"), std::string::npos) << seed << run.record.message;
  }
}

// Whichever paths are drawn, the left arm comes too near to the right one if it goes home first.
TEST(ArmsCampaign, WhenTheFirstArmHasNoWayBesideTheOther_ThenTheOtherGoesFirst) {
  const ArmsRun run = run_arms(235);
  EXPECT_EQ(run.kind, "move");
  EXPECT_EQ(run.verdict, Verdict::GoalReached) << run.story << ": " << run.why;
}

// It goes back by the way that it came, and around.
TEST(ArmsCampaign, WhenAPostIsPutIntoTheWay_ThenTheOrderIsDoneAllTheSame) {
  for (const std::uint64_t seed : {7U, 15U, 23U}) {
    const ArmsRun run = run_arms(seed);
    EXPECT_EQ(run.kind, "block");
    EXPECT_EQ(run.verdict, Verdict::GoalReached) << run.story << ": " << run.why << run.record.message;
  }
}

}  // namespace
}  // namespace stepwright::campaign
