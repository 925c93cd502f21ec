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

// So near to the end of its path that its drive does not trip: the arm is not at home, and the joint is
// named.
TEST(ArmsCampaign, WhenAJointSticksJustBeforeTheEnd_ThenTheRunEndsWithThatJoint) {
  const ArmsRun run = run_arms(28);
  EXPECT_EQ(run.kind, "stuck");
  EXPECT_EQ(run.verdict, Verdict::SafeStop) << run.story << ": " << run.why;
  EXPECT_NE(run.record.message.find("joint 3 of the right arm is 0."), std::string::npos)
      << run.record.message;
  EXPECT_NE(run.record.message.find("it is stuck"), std::string::npos) << run.record.message;
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
