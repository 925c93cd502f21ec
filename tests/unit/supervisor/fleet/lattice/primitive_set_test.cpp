#include "supervisor/fleet/lattice/primitive_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

namespace stepwright::fleet {
namespace {

using geometry::Pose;
using geometry::Travel;

struct Case {
  double radius_m;
  double resolution_m;
};

class Primitives : public ::testing::TestWithParam<Case> {
 protected:
  VehicleModel vehicle_{.min_turning_radius_m = GetParam().radius_m};
  PrimitiveSet set_{vehicle_, {.resolution_m = GetParam().resolution_m}};
};

double angle_between(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

// Start heading, end, end heading, travel, cost: what makes a primitive.
using Shape = std::tuple<int, int, int, int, bool, std::uint32_t>;

Shape shape(const MotionPrimitive& p) {
  return {p.start_heading, p.end.x, p.end.y, p.end_heading, p.travel == Travel::Reverse, p.cost_mm};
}

std::set<Shape> shapes(const PrimitiveSet& set) {
  std::set<Shape> result;
  for (const MotionPrimitive& p : set.all()) result.insert(shape(p));
  return result;
}

TEST_P(Primitives, All_WhenGenerated_ThenSixteenDifferentOnesLeaveEachHeading) {
  EXPECT_EQ(set_.all().size(), 256u);
  EXPECT_EQ(shapes(set_).size(), 256u);
  for (int heading = 0; heading < kHeadings; ++heading) {
    const auto from = set_.from(heading);
    EXPECT_TRUE(std::ranges::all_of(from, [&](const auto& p) { return p.start_heading == heading; }));
    EXPECT_EQ(std::ranges::count(from, Travel::Reverse, &MotionPrimitive::travel), 8);
  }
}

TEST_P(Primitives, PoseAlong_WhenDrivenToTheEnd_ThenItIsTheVertexAndTheHeadingExactly) {
  for (const MotionPrimitive& p : set_.all()) {
    const Pose start = pose_along(p, 0.0);
    EXPECT_EQ(start.position(), (geometry::Point{0.0, 0.0}));
    EXPECT_LT(angle_between(start.heading_rad, heading_rad(p.start_heading)), 1e-12);
    const Pose end = pose_along(p, p.length_m);
    EXPECT_NEAR(end.x_m, GetParam().resolution_m * p.end.x, 1e-12);
    EXPECT_NEAR(end.y_m, GetParam().resolution_m * p.end.y, 1e-12);
    EXPECT_LT(angle_between(end.heading_rad, heading_rad(p.end_heading)), 1e-12);
  }
}

// By differences of poses, not by the segments: heading turns no faster than the radius allows, and no wheel
// slips sideways.
TEST_P(Primitives, PoseAlong_WhenDrivenStepByStep_ThenTheVehicleCanDoIt) {
  for (const MotionPrimitive& p : set_.all()) {
    constexpr int kSteps = 400;
    const double step_m = p.length_m / kSteps;
    const double sign = p.travel == Travel::Reverse ? -1.0 : 1.0;
    Pose before = pose_along(p, 0.0);
    for (int k = 1; k <= kSteps; ++k) {
      const Pose here = pose_along(p, step_m * k);
      const double turn = angle_between(here.heading_rad, before.heading_rad);
      EXPECT_LE(turn, step_m / vehicle_.min_turning_radius_m + 1e-9);
      const double middle = before.heading_rad + 0.5 * std::remainder(here.heading_rad - before.heading_rad,
                                                                      2.0 * std::numbers::pi);
      const geometry::Point moved = here.position() - before.position();
      const geometry::Point ahead{std::cos(middle), std::sin(middle)};
      EXPECT_NEAR(sign * dot(ahead, moved), step_m, 1e-4 * step_m);
      // Within a step the curvature may change: the chord is then off the mean heading by what a step turns.
      EXPECT_NEAR(cross(ahead, moved), 0.0, step_m * step_m / vehicle_.min_turning_radius_m);
      before = here;
    }
  }
}

TEST_P(Primitives, Cost_WhenReverseOrTurning_ThenFactorsApplyRoundedUp) {
  for (const MotionPrimitive& p : set_.all()) {
    const double factor = (p.travel == Travel::Reverse ? 2.0 : 1.0) * (p.straight() ? 1.0 : 1.2);
    EXPECT_GE(p.cost_mm, 1000.0 * p.length_m * factor - 1e-5);
    EXPECT_LT(p.cost_mm, 1000.0 * p.length_m * factor + 1.0);
  }
  EXPECT_EQ(std::ranges::count_if(set_.from(3), &MotionPrimitive::straight), 4);
}

TEST_P(Primitives, All_WhenTurnedMirroredOrDrivenBackwards_ThenTheSetIsTheSame) {
  const std::set<Shape> expected = shapes(set_);
  std::set<Shape> turned_set;
  std::set<Shape> mirrored;
  std::set<Shape> back;
  for (const MotionPrimitive& p : set_.all()) {
    const bool reverse = p.travel == Travel::Reverse;
    turned_set.insert({wrap_heading(p.start_heading + kQuarter), -p.end.y, p.end.x,
                       wrap_heading(p.end_heading + kQuarter), reverse, p.cost_mm});
    mirrored.insert({wrap_heading(-p.start_heading), p.end.x, -p.end.y, wrap_heading(-p.end_heading), reverse,
                     p.cost_mm});
    back.insert({p.end_heading, -p.end.x, -p.end.y, p.start_heading, !reverse, reverse ? 0 : 1});
  }
  EXPECT_EQ(turned_set, expected);
  EXPECT_EQ(mirrored, expected);
  std::set<Shape> without_costs;
  for (const MotionPrimitive& p : set_.all()) {
    Shape s = shape(p);
    std::get<5>(s) = p.travel == Travel::Reverse ? 1 : 0;
    without_costs.insert(s);
  }
  EXPECT_EQ(back, without_costs);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, Primitives,
                         ::testing::Values(Case{3.5, 0.2}, Case{1.2, 0.2}, Case{6.0, 0.3}));

TEST(PrimitiveSet, Digest_WhenACostOrAnEndChanges_ThenItChanges) {
  const VehicleModel vehicle;
  const Digest digest = PrimitiveSet(vehicle, {}).digest();
  EXPECT_EQ(PrimitiveSet(vehicle, {}).digest(), digest);
  EXPECT_NE(PrimitiveSet(vehicle, {.turn_factor = 1.3}).digest(), digest);
  EXPECT_NE(PrimitiveSet({.min_turning_radius_m = 4.5}, {}).digest(), digest);
}

TEST(Heading, Nearest_WhenTheAngleIsThatOfAHeading_ThenItIsFoundInEveryTurn) {
  for (int heading = -20; heading < 40; ++heading) {
    EXPECT_EQ(nearest_heading(heading_rad(heading) + 6.0 * std::numbers::pi + 0.1), wrap_heading(heading));
  }
  EXPECT_DOUBLE_EQ(heading_rad(2), std::numbers::pi / 4);
  EXPECT_EQ(heading_vector(-1), (GridVector{2, -1}));
}

}  // namespace
}  // namespace stepwright::fleet
