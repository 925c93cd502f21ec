// Capsules contain the bodies of arms, and pieces of a chain of joints are where the planner's kinematics
// have them.

#include "supervisor/tamp/schedule/arm_capsules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/spatial/random.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::schedule {
namespace {

using motion::Vector3;

// A point of the body, in the frame of its link; as a rule of its surface.
Vector3 point_of(const motion::Shape& shape, motion::Random& random) {
  const double angle = random.between(0.0, 2.0 * std::numbers::pi);
  Vector3 at;
  if (shape.kind == motion::ShapeKind::Box) {
    at = {random.between(-0.5, 0.5) * shape.size_m.x, random.between(-0.5, 0.5) * shape.size_m.y,
          std::copysign(0.5, random.between(-1.0, 1.0)) * shape.size_m.z};
    if (random.between(0.0, 1.0) < 0.5) at.x = std::copysign(0.5 * shape.size_m.x, at.x);
    if (random.between(0.0, 1.0) < 0.5) at.y = std::copysign(0.5 * shape.size_m.y, at.y);
  } else if (shape.kind == motion::ShapeKind::Cylinder) {
    at = {shape.radius_m * std::cos(angle), shape.radius_m * std::sin(angle),
          random.between(-0.5, 0.5) * shape.length_m};
    if (random.between(0.0, 1.0) < 0.5) at.z = std::copysign(0.5 * shape.length_m, at.z);
  } else {
    const double z = random.between(-1.0, 1.0), aside = std::sqrt(1.0 - z * z);
    at = shape.radius_m * Vector3{aside * std::cos(angle), aside * std::sin(angle), z};
  }
  return shape.origin * at;
}

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
  std::vector<motion::Transform> frames(cell_.robot.links.size());
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const ArmCapsules model = arm_capsules(cell_, arm);
    EXPECT_LE(model.capsules.size(), 12u);
    const int first = motion::Robot::link_below(
        cell_.robot.coordinates[static_cast<std::size_t>(cell_.arms[arm].coordinates.front())].joint);
    double worst = -1.0;
    for (int k = 0; k < 12; ++k) {
      const std::vector<double> values = random_values(random);
      motion::LinkFrames(cell_.robot).place(values, frames);
      const std::vector<Capsule> capsules = capsules_at(model, joints_of(arm, values));
      for (std::size_t link = 0; link < frames.size(); ++link) {
        if (!cell_.robot.hangs_below(static_cast<int>(link), first)) continue;
        for (const motion::Shape& shape : cell_.robot.links[link].shapes)
          for (int n = 0; n < 20; ++n) {
            const Vector3 at = frames[link] * point_of(shape, random);
            double nearest = 1e9;
            for (const Capsule& each : capsules)
              nearest = std::min(nearest, distance_of(each, {1, at, at, 0.0}));
            worst = std::max(worst, nearest);
          }
      }
    }
    EXPECT_LE(worst, 1e-9);
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
