#include "supervisor/motion/timing/plan_timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "supervisor/motion/blend/codes.h"
#include "supervisor/motion/timing/double_s.h"
#include "tests/unit/supervisor/motion/timing/judge.h"

namespace stepwright::motion {
namespace {

struct Planned {
  BlendedPath path;
  TimeLaw law;
};

Planned planned(const tests::TimingCase& problem) {
  auto path = blend(problem.points, {.tolerance = problem.tolerance});
  EXPECT_TRUE(path);
  auto law = plan_timing(*path, problem.limits);
  EXPECT_TRUE(law);
  return {std::move(*path), std::move(*law)};
}

TEST(PlanTiming, WhenPathsAreRandom_ThenAllLimitsAreKeptAndOneIsMet) {
  Random random(1);
  std::size_t most_rows = 0;
  for (int round = 0; round < 150; ++round) {
    const std::size_t joints = 1 + random.below(14);
    const auto problem = tests::random_case(random, 2 + random.below(6), joints);
    const Planned found = planned(problem);
    const tests::Verdict verdict = tests::judge(found.path, found.law, problem.limits);
    ASSERT_LE(verdict.worst, 1.0 + 1e-9) << round;
    ASSERT_GE(verdict.worst, 0.99) << round;
    ASSERT_LE(verdict.broken, 1e-9) << round;
    ASSERT_TRUE(verdict.forward) << round;
    most_rows = std::max(most_rows, found.law.rows.size());
  }
  EXPECT_LT(most_rows, 800U);
}

TEST(PlanTiming, WhenComparedWithAFinerGrid_ThenItIsWithinOnePercent) {
  Random random(2);
  int proved = 0;
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    const auto problem = tests::random_case(random, 3 + random.below(3), 1 + random.below(7));
    const Planned found = planned(problem);
    const auto bound = bound_timing(found.path, problem.limits, 4);
    ASSERT_TRUE(bound);
    EXPECT_LE(found.law.duration(), 1.01 * bound->minimum) << round;
    EXPECT_TRUE(bound->proved) << round;
    EXPECT_LE(bound->seconds, found.law.duration()) << round;
    EXPECT_LE(found.law.duration(), 1.12 * bound->seconds) << round;
    proved += found.law.duration() <= 1.01 * bound->seconds ? 1 : 0;
  }
  EXPECT_GE(proved, kRounds / 2);  // to be within one percent of anything at all
}

// What is straight in truth, planned as if it was not, against the exact double S.
TEST(PlanTiming, WhenWayPointsLieOnALine_ThenTheOptimumIsThatOfTheDoubleS) {
  Random random(3);
  for (int round = 0; round < 25; ++round) {
    auto problem = tests::random_case(random, 2, 1 + random.below(4));
    const double length = random.between(0.1, 3.0);
    for (double& each : problem.points[1]) each *= length;
    const Configuration from = problem.points[0], to = problem.points[1];
    if (joint_distance(from, to) < 1e-3) continue;
    const double share = random.between(0.2, 0.8);
    Configuration middle(from);
    for (std::size_t j = 0; j < from.size(); ++j) middle[j] += share * (to[j] - from[j]);
    problem.points = {from, middle, to};
    const Planned found = planned(problem);
    ASSERT_GT(found.path.half_widths()[1], 0.0);
    const double exact = plan_straight(from, to, problem.limits)->duration();
    EXPECT_LE(found.law.duration(), 1.01 * exact) << round;
    EXPECT_GE(found.law.duration(), (1.0 - 1e-6) * exact) << round;
  }
}

TEST(PlanTiming, WhenLimitsAndTolerancesAreExtreme_ThenTheyAreKept) {
  Random random(4);
  for (int round = 0; round < 40; ++round) {
    auto problem = tests::random_case(random, 3 + random.below(2), 1 + random.below(4));
    const auto factor = [&] { return std::pow(10.0, random.between(-3.0, 3.0)); };
    for (std::size_t j = 0; j < problem.limits.velocity.size(); ++j) {
      problem.limits.velocity[j] *= factor();
      problem.limits.acceleration[j] *= factor();
      problem.limits.jerk[j] *= factor();
    }
    problem.tolerance = std::pow(10.0, random.between(-6.0, 1.0));
    const Planned found = planned(problem);
    const tests::Verdict verdict = tests::judge(found.path, found.law, problem.limits);
    ASSERT_LE(verdict.worst, 1.0 + 1e-9) << round;
    ASSERT_GE(verdict.worst, 0.9) << round;
    ASSERT_LE(verdict.broken, 1e-7) << round;
    ASSERT_TRUE(verdict.forward) << round;
  }
}

TEST(PlanTiming, WhenItIsPlannedOnAnyMachine_ThenTheBitsAreTheSame) {
  Random random(5);
  std::uint64_t hash = 0;
  for (int round = 0; round < 6; ++round) {
    const auto problem = tests::random_case(random, 2 + random.below(5), 7);
    const Planned found = planned(problem);
    hash = hash * 31U + tests::hash_of(found.law);
  }
  EXPECT_EQ(hash, 4254636357915466244U);
}

TEST(PlanTiming, WhenInputIsWrong_ThenItIsSaidWhere) {
  const auto path = *blend({{0.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}});
  const JointLimits sound{{1.0, 1.0}, {5.0, 5.0}, {50.0, 50.0}};
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  const auto refused = [&](JointLimits limits, const char* code, const char* words) {
    for (const bool bound : {false, true}) {
      const auto errors = bound ? bound_timing(path, limits).error() : plan_timing(path, limits).error();
      EXPECT_EQ(errors.front().code, code);
      EXPECT_NE(errors.front().message.find(words), std::string::npos) << errors.front().message;
    }
  };
  for (const double wrong : {0.0, -1.0, nan, far, 1e-9, 1e12}) {
    JointLimits limits = sound;
    limits.velocity[1] = wrong;
    refused(limits, code::kBadLimit, "joint 2: the limit of velocity");
    limits = sound;
    limits.acceleration[0] = wrong;
    refused(limits, code::kBadLimit, "joint 1: the limit of acceleration");
    limits = sound;
    limits.jerk[1] = wrong;
    refused(limits, code::kBadLimit, "joint 2: the limit of jerk");
  }
  JointLimits few = sound;
  few.jerk.pop_back();
  refused(few, code::kJointCount, "limits of jerk for 1 joints");
}

}  // namespace
}  // namespace stepwright::motion
