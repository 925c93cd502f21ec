// Capsules contain the bodies of arms, and pieces of a chain of joints are where the planner's kinematics
// have them.

#include "supervisor/tamp/schedule/arm_capsules.h"

#include <gtest/gtest.h>

#include <cmath>

#include "supervisor/motion/spatial/random.h"
#include "tests/support/tamp_cells/arm_points.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::schedule {
namespace {

using motion::Vector3;

class ArmCapsulesOfTheTree : public testing::Test {
 protected:
  void SetUp() override {
    auto problem = test::paper_problem("p1");
    ASSERT_TRUE(problem);
    cell_ = std::move(problem->cell);
  }
  // Values for all coordinates, and those of the arm.
  std::vector<double> random_values(motion::Random& random) const {
    std::vector<double> values;
    for (const motion::Coordinate& each : cell_.robot.coordinates)
      values.push_back(random.between(each.lower, each.upper));
    return values;
  }
  std::vector<double> joints_of(std::size_t arm, const std::vector<double>& values) const {
    std::vector<double> joints;
    for (const int each : cell_.arms[arm].coordinates)
      joints.push_back(values[static_cast<std::size_t>(each)]);
    return joints;
  }
  scene::RobotCell cell_;
};

TEST_F(ArmCapsulesOfTheTree, WhenJointsAndFingersMove_ThenAllBodiesAreWithinCapsules) {
  motion::Random random(3);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    ArmCapsules model = arm_capsules(cell_, arm);
    EXPECT_LE(model.capsules.size(), 11u) << "one more for what is held";
    EXPECT_LE(test::farthest_outside(cell_, arm, model, random, {.places = 40, .points = 100}), 1e-9);
    // With a finger's capsule 2 mm thinner they are not.
    model.capsules.back().radius_m -= 0.002;
    EXPECT_GT(test::farthest_outside(cell_, arm, model, random, {.places = 40, .points = 100}), 0.0);
  }
}

TEST_F(ArmCapsulesOfTheTree, WhenAThingIsHeld_ThenItIsWithinItsCapsule) {
  motion::Random random(4);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const double hand_rad = random.between(-3.0, 3.0);
    ArmCapsules model = arm_capsules(cell_, arm);
    model.capsules.push_back(held_capsule(cell_, arm, 0, hand_rad));
    const std::vector<double> joints = joints_of(arm, random_values(random));
    const Capsule held = capsules_at(model, joints).back();
    // Where the planner's surroundings have it.
    const motion::Transform tool = cell_.arms[arm].base * cell_.arms[arm].chain.forward(joints);
    const motion::Transform thing = tool * inverse(scene::tool_pose(0.0, 0.0, cell_.tool_above(0), hand_rad));
    const scene::Form& form = cell_.things[0].form;
    for (int k = 0; k < 200; ++k) {
      const double angle = random.between(0.0, 6.3);
      const Vector3 at = thing * Vector3{form.radius_m * std::cos(angle), form.radius_m * std::sin(angle),
                                         k % 2 == 0 ? 0.0 : form.height_m};
      EXPECT_LE(distance_of(held, {1, at, at, 0.0}), 1e-9);
    }
    EXPECT_LT(held.radius_m, form.radius_m + 0.01);
  }
}

TEST(CapsuleDistance, WhenCapsulesAreRandom_ThenNoPairOfPointsIsNearer) {
  motion::Random random(5);
  const auto point = [&] {
    return Vector3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  };
  for (int k = 0; k < 60; ++k) {
    const Capsule a{1, point(), point(), random.between(0.0, 0.2)};
    const Vector3 from = point();
    // Some lie side by side.
    const Vector3 to = k % 5 == 0 ? from + 0.7 * (a.to - a.from) : point();
    const Capsule b{1, from, to, random.between(0.0, 0.2)};
    double nearest = 1e9;
    constexpr int kPlaces = 60;
    for (int i = 0; i <= kPlaces; ++i)
      for (int j = 0; j <= kPlaces; ++j) {
        const Vector3 on_a = a.from + (1.0 * i / kPlaces) * (a.to - a.from);
        const Vector3 on_b = b.from + (1.0 * j / kPlaces) * (b.to - b.from);
        nearest = std::min(nearest, distance(on_a, on_b) - a.radius_m - b.radius_m);
      }
    EXPECT_LE(distance_of(a, b), nearest + 1e-12);
    EXPECT_GE(distance_of(a, b), nearest - 0.03);
    EXPECT_NEAR(distance_of(a, b), distance_of(b, a), 1e-12);
  }
}

}  // namespace
}  // namespace stepwright::tamp::schedule
