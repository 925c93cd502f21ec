#include "supervisor/motion/timing/motion_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "supervisor/motion/blend/codes.h"
#include "tests/unit/supervisor/motion/timing/judge.h"

namespace stepwright::motion {
namespace {

// The block of supervisor/doc/motion_timing.md.
class Block {
 public:
  Block(const MotionTable& table, double dt) : table_(table), dt_(dt), last_(table.places.size() - 1) {}

  double override_value = 0.0, path_time = 0.0;
  bool done = false;

  Configuration scan(double target) {
    const double rate = table_.override_rates.per_s, change = table_.override_rates.per_s2;
    const double sign = target >= override_value ? 1.0 : -1.0, ahead = sign * (target - override_value),
                 now = sign * slope_;
    double wanted = 0.0;
    if (const double room = ahead - 0.5 * now * dt_; room > 0.0)
      wanted = std::min(rate, change * (std::sqrt(dt_ * dt_ + 2.0 * room / change) - dt_));
    const double bend = sign * std::clamp((wanted - now) / dt_, -change, change);
    path_time += dt_ * (override_value + dt_ * (slope_ / 2.0 + dt_ * bend / 6.0));
    override_value += dt_ * (slope_ + dt_ * bend / 2.0);
    slope_ += dt_ * bend;
    return interpolated();
  }

 private:
  Configuration interpolated() {
    Configuration q(table_.joints);
    const auto& t = table_.begins_s;
    if (path_time >= t.back()) {
      done = true;
      path_time = t.back();
      for (std::size_t j = 0; j < q.size(); ++j) q[j] = table_.points[last_ * q.size() + j];
      return q;
    }
    while (row_ + 1 < table_.rows() && path_time >= t[row_ + 1]) ++row_;
    double x = (path_time - t[row_]) * table_.rates[row_];
    const double* c = table_.coefficients.data() + 6 * row_;
    const double place = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
    const auto& s = table_.places;
    const auto& h = table_.half_widths;
    while (part_ + 1 < last_ && place >= s[part_ + 1] + h[part_ + 1]) ++part_;
    const double d = place - s[part_ + 1];
    double g = 0.0;
    const bool within = d > -h[part_ + 1];
    if (within && part_ + 1 < last_) {
      x = d / h[part_ + 1];
      g = h[part_ + 1] * (3.0 + x * (8.0 + x * (6.0 - x * x))) / 16.0;
    }
    for (std::size_t j = 0; j < q.size(); ++j) {
      const double u = table_.directions[part_ * q.size() + j];
      q[j] = table_.points[(part_ + 1) * q.size() + j] + u * d;
      if (within && part_ + 1 < last_) q[j] += (table_.directions[(part_ + 1) * q.size() + j] - u) * g;
    }
    return q;
  }

  const MotionTable& table_;
  double dt_, slope_ = 0.0;
  std::size_t last_, row_ = 0, part_ = 0;
};

struct Made {
  tests::TimingCase problem;
  BlendedPath path;
  TimeLaw law;
  MotionTable table;
};

Made made(Random& random) {
  auto problem = tests::random_case(random, 2 + random.below(4), 7);
  auto path = *blend(problem.points, {.tolerance = problem.tolerance});
  auto law = *plan_timing(path, problem.limits);
  auto table = *motion_table(path, law, problem.limits, stop_limits(problem.limits));
  return {std::move(problem), std::move(path), std::move(law), std::move(table)};
}

TEST(MotionTable, WhenTheBlockRunsAsPlanned_ThenJointsAreThoseOfThePath) {
  Random random(1);
  for (int round = 0; round < 10; ++round) {
    const Made motion = made(random);
    Block block(motion.table, 0.004);
    Configuration q, expected(7);
    double begun = 0.0;
    for (int k = 0; k < 10'000 && !block.done; ++k) {
      q = block.scan(1.0);
      motion.path.at(motion.law.at(block.path_time).place, expected);
      ASSERT_LT(joint_distance(q, expected), 1e-9);
      begun += 0.004;
    }
    EXPECT_TRUE(block.done);
    EXPECT_EQ(q, motion.problem.points.back());
    EXPECT_NEAR(begun, motion.law.duration() + 0.5 * motion.table.override_rates.stopping_time_s(), 0.02);
  }
}

// Differences of positions are means of derivatives, so that they keep the limits of these.
TEST(MotionTable, WhenTheOverrideChangesAtRandom_ThenStopLimitsAreKept) {
  Random random(2);
  constexpr double kScan = 0.002;
  for (int round = 0; round < 12; ++round) {
    const Made motion = made(random);
    const StopLimits stop = stop_limits(motion.problem.limits);
    Block block(motion.table, kScan);
    std::vector<Configuration> q(4, motion.problem.points.front());
    double target = 1.0;
    for (int k = 0; k < 20'000 && !block.done; ++k) {
      if (random.below(150) == 0) target = std::array<double, 4>{0.0, 0.3, 1.0, 1.0}[random.below(4)];
      if (target == 0.0 && block.override_value < 1e-9) target = 1.0;
      q = {q[1], q[2], q[3], block.scan(target)};
      ASSERT_LE(block.override_value, 1.0 + 1e-9);
      ASSERT_GE(block.override_value, -1e-9);
      if (block.done) break;
      for (std::size_t j = 0; j < 7; ++j) {
        ASSERT_LE(std::abs(q[3][j] - q[2][j]) / kScan, motion.problem.limits.velocity[j] * (1.0 + 1e-6));
        ASSERT_LE(std::abs(q[3][j] - 2.0 * q[2][j] + q[1][j]) / (kScan * kScan),
                  stop.acceleration[j] * (1.0 + 1e-6));
        ASSERT_LE(std::abs(q[3][j] - 3.0 * q[2][j] + 3.0 * q[1][j] - q[0][j]) / (kScan * kScan * kScan),
                  stop.jerk[j] * (1.0 + 1e-4))
            << round << " " << k << " " << block.override_value;
      }
    }
    EXPECT_TRUE(block.done);
  }
}

TEST(MotionTable, WhenAskedToStop_ThenItRestsWithinTheStoppingTime) {
  Random random(3);
  const Made motion = made(random);
  Block block(motion.table, 0.001);
  while (block.override_value < 1.0 - 1e-9 && !block.done) block.scan(1.0);
  double time = 0.0;
  while (block.override_value > 1e-6) {
    block.scan(0.0);
    time += 0.001;
    ASSERT_LT(time, 10.0);
  }
  EXPECT_NEAR(time, motion.table.override_rates.stopping_time_s(), 0.02);
}

TEST(MotionTable, WhenItDoesNotFitOrNothingIsLeftForAStop_ThenItIsSaid) {
  Random random(4);
  const Made motion = made(random);
  const auto& limits = motion.problem.limits;
  const auto code_of = [&](const StopLimits& stop, const TableCapacity& capacity) {
    return motion_table(motion.path, motion.law, limits, stop, capacity).error().front().code;
  };
  EXPECT_EQ(code_of(stop_limits(limits), {.rows = 3}), code::kTableFull);
  EXPECT_EQ(code_of(stop_limits(limits), {.way_points = 1}), code::kTableFull);
  EXPECT_EQ(code_of(stop_limits(limits), {.joints = 6}), code::kTableFull);
  EXPECT_EQ(code_of(stop_limits(limits, 1.0), {}), code::kBadStopLimits);
  EXPECT_EQ(code_of(stop_limits(limits, 2.0, 1.0), {}), code::kBadStopLimits);
  EXPECT_EQ(code_of({{1.0}, {1.0}}, {}), code::kJointCount);
}

}  // namespace
}  // namespace stepwright::motion
