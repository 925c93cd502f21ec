#include "supervisor/tamp/scene/upright.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "supervisor/motion/collision/world.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::scene {
namespace {

Form draw_form(motion::Random& random) {
  Form form;
  form.round = random.unit() < 0.5;
  form.radius_m = random.between(0.02, 0.08);
  form.size_x_m = random.between(0.02, 0.2);
  form.size_y_m = random.between(0.02, 0.2);
  form.height_m = random.between(0.05, 0.2);
  return form;
}

Pose draw_pose(motion::Random& random) {
  return {random.between(-0.15, 0.15), random.between(-0.15, 0.15), 0.0, random.between(-3.0, 3.0)};
}

// Of points on the outline of `a` to `b`: not less than the true distance, by little more.
double sampled_gap(const Form& a, const Pose& at, const Form& b, const Pose& other) {
  const motion::Shape solid = obstacle_of("b", b, other).shape;
  double least = 1.0;
  constexpr int kSteps = 400;
  for (int k = 0; k < kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    motion::Vector3 point;
    if (a.round) {
      point = {a.radius_m * std::cos(6.283185307 * t), a.radius_m * std::sin(6.283185307 * t), 0.0};
    } else {
      const double side = std::floor(4.0 * t), along = 2.0 * (4.0 * t - side) - 1.0;
      const double x = 0.5 * a.size_x_m, y = 0.5 * a.size_y_m;
      point = side == 0.0   ? motion::Vector3{along * x, y, 0.0}
              : side == 1.0 ? motion::Vector3{x, along * y, 0.0}
              : side == 2.0 ? motion::Vector3{along * x, -y, 0.0}
                            : motion::Vector3{-x, along * y, 0.0};
    }
    motion::Vector3 in_world = frame_of(at) * point;
    in_world.z = 0.025;  // within both heights
    least = std::min(least, motion::distance_to(solid, in_world));
  }
  return least;
}

TEST(Upright, WhenBodiesAreDrawn_ThenTheirGapIsThatOfTheirSolids) {
  motion::Random random(7);
  int apart = 0;
  for (int k = 0; k < 2000; ++k) {
    const Form a = draw_form(random), b = draw_form(random);
    const Pose at = draw_pose(random), other = draw_pose(random);
    const double said = gap(standing(a, at), standing(b, other));
    const double seen = std::min(sampled_gap(a, at, b, other), sampled_gap(b, other, a, at));
    EXPECT_LE(said, seen + 1e-9);
    // Two rectangles may be farther apart than said, at their corners; never are they said to meet.
    if (seen > 1e-3) {
      ++apart;
      EXPECT_GT(said, a.round || b.round ? seen - 2e-3 : 0.0);
    }
    if (said > 0.0) {
      EXPECT_GT(seen, 0.0);
    }
  }
  EXPECT_GT(apart, 500);
}

TEST(Upright, WhenOneStandsOnTheOther_ThenTheyDoNotMeet) {
  const Form can{.round = true, .radius_m = 0.03, .height_m = 0.1};
  EXPECT_FALSE(meet(standing(can, {0, 0, 0, 0}), standing(can, {0, 0, 0.1, 0}), 0.01));
  EXPECT_TRUE(meet(standing(can, {0, 0, 0, 0}), standing(can, {0, 0, 0.09, 0}), 0.0));
  EXPECT_TRUE(meet(standing(can, {0, 0, 0, 0}), standing(can, {0.065, 0, 0, 0}), 0.01));
}

}  // namespace
}  // namespace stepwright::tamp::scene
