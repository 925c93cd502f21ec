#include "supervisor/motion/timing/double_s.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "supervisor/motion/blend/codes.h"
#include "tests/unit/supervisor/motion/timing/judge.h"

namespace stepwright::motion {
namespace {

// Shortest time from rest to rest as textbooks have it, case by case.
double textbook(double length, const AxisLimits& limits) {
  const double v = limits.velocity, a = limits.acceleration, j = limits.jerk;
  if (v * j >= a * a) {
    if (length >= v * (v / a + a / j)) return length / v + v / a + a / j;
    if (length < 2.0 * a * a * a / (j * j)) return 4.0 * std::cbrt(length / (2.0 * j));
    return a / j + std::sqrt(a * a / (j * j) + 4.0 * length / a);
  }
  if (length >= 2.0 * v * std::sqrt(v / j)) return length / v + 2.0 * std::sqrt(v / j);
  return 4.0 * std::cbrt(length / (2.0 * j));
}

double duration_of(const std::vector<TimeRow>& rows) {
  return TimeLaw{rows}.duration();
}

double power_of_ten(Random& random, double lower, double upper) {
  return std::pow(10.0, random.between(lower, upper));
}

TEST(DoubleS, WhenFromRest_ThenItIsTheShortestOfTextbooksAndKeepsLimits) {
  Random random(1);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t joints = 1 + random.below(14);
    tests::TimingCase problem = tests::random_case(random, 2, joints);
    for (std::size_t j = 0; j < joints; ++j) {
      problem.limits.velocity[j] = power_of_ten(random, -2.0, 2.0);
      problem.limits.acceleration[j] = power_of_ten(random, -2.0, 3.0);
      problem.limits.jerk[j] = power_of_ten(random, -2.0, 4.0);
    }
    const auto law = plan_straight(problem.points[0], problem.points[1], problem.limits);
    ASSERT_TRUE(law) << to_string(law.error());
    const BlendedPath path(problem.points, {0.0, 0.0});
    const tests::Verdict verdict = tests::judge(path, *law, problem.limits, 4);
    ASSERT_LE(verdict.worst, 1.0 + 1e-9) << round;
    ASSERT_LE(verdict.broken, 1e-9) << round;
    ASSERT_TRUE(verdict.forward);
    ASSERT_LE(law->rows.size(), 7U);
    AxisLimits axis{1e300, 1e300, 1e300};
    for (std::size_t j = 0; j < joints; ++j) {
      const double share = std::abs(path.directions()[0][j]);
      axis.velocity = std::min(axis.velocity, problem.limits.velocity[j] / share);
      axis.acceleration = std::min(axis.acceleration, problem.limits.acceleration[j] / share);
      axis.jerk = std::min(axis.jerk, problem.limits.jerk[j] / share);
    }
    const double shortest = textbook(path.length(), axis);
    ASSERT_NEAR(law->duration(), shortest, 1e-9 * shortest) << round;
  }
}

TEST(DoubleS, WhenItGoesOnFromASpeed_ThenItIsAsShortAsTheRestOfTheWholeMotion) {
  const AxisLimits limits{1.0, 4.0, 30.0};
  const double length = 2.0;
  const auto whole = *double_s(length, 0.0, limits);
  ASSERT_EQ(whole.size(), 7U);
  double before = 0.0;
  for (int k = 0; k < 3; ++k) before += whole[static_cast<std::size_t>(k)].duration;
  // In the middle of the part with constant speed, and at its begin.
  for (const double share : {0.0, 0.5, 1.0}) {
    const Along now = along(whole[3], share);
    const auto rest = double_s(length - now.place, now.speed, limits);
    ASSERT_TRUE(rest);
    EXPECT_NEAR(duration_of(*rest), duration_of(whole) - before - share * whole[3].duration, 1e-7);
  }
}

TEST(DoubleS, WhenTheStartSpeedIsRandom_ThenLimitsAreKeptAndNothingTriedIsShorter) {
  Random random(2);
  int stopped = 0;
  for (int round = 0; round < 2000; ++round) {
    const AxisLimits limits{power_of_ten(random, -1.0, 1.0), power_of_ten(random, -1.0, 2.0),
                            power_of_ten(random, -1.0, 3.0)};
    const double speed = limits.velocity * random.between(0.0, 1.3), length = power_of_ten(random, -2.0, 1.0);
    const auto rows = double_s(length, speed, limits);
    if (!rows) {
      EXPECT_GT(stopping_distance(speed, limits), length);
      ++stopped;
      continue;
    }
    const BlendedPath path({{0.0}, {length}}, {0.0, 0.0});
    const double fastest = std::max(speed, limits.velocity);
    const tests::Verdict verdict =
        tests::judge(path, {*rows}, {{fastest}, {limits.acceleration}, {limits.jerk}}, 6);
    ASSERT_LE(verdict.worst, 1.0 + 1e-9) << round;
    ASSERT_LE(verdict.broken, 1e-8) << round;
    ASSERT_TRUE(verdict.forward);
    if (speed > limits.velocity) continue;
    // Speeds up to any lower peak and stays there for the rest of the way.
    for (int k = 0; k <= 20; ++k) {
      const double peak = speed + (limits.velocity - speed) * k / 20.0;
      const auto time = [&](double from, double to) {
        const double gap = std::abs(to - from);
        return gap * limits.jerk < limits.acceleration * limits.acceleration
                   ? 2.0 * std::sqrt(gap / limits.jerk)
                   : gap / limits.acceleration + limits.acceleration / limits.jerk;
      };
      const double way = 0.5 * (speed + peak) * time(speed, peak) + 0.5 * peak * time(peak, 0.0);
      if (way > length || peak <= 0.0) continue;
      EXPECT_LE(duration_of(*rows),
                (time(speed, peak) + time(peak, 0.0) + (length - way) / peak) * (1.0 + 1e-9));
    }
  }
  EXPECT_GT(stopped, 100);
  EXPECT_LT(stopped, 1900);
}

TEST(DoubleS, WhenItCannotStop_ThenItIsSaidHowFarItTakes) {
  const JointLimits limits{{1.0}, {1.0}, {10.0}};
  const auto law = plan_straight({0.0}, {0.1}, limits, 0.9);
  ASSERT_FALSE(law);
  EXPECT_EQ(law.error().front().code, code::kCannotStop);
  EXPECT_NE(law.error().front().message.find("0.45"), std::string::npos) << law.error().front().message;
  EXPECT_FALSE(plan_straight({0.0}, {0.1}, limits, -1.0));
  EXPECT_FALSE(plan_straight({0.0}, {0.0}, limits));
}

}  // namespace
}  // namespace stepwright::motion
