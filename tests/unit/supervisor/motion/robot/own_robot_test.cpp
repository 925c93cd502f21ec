#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

TEST(TwoArms, WhenItIsRead_ThenItHasTwoArmsOfSevenJointsAndTwoHands) {
  const Robot robot = tests::two_arms();
  EXPECT_EQ(robot.coordinates.size(), 16u);
  EXPECT_EQ(robot.links.size(), 24u);
  const Semantics semantics = tests::two_arms_semantics(robot);
  for (const std::string side : {"left", "right"}) {
    ASSERT_NE(semantics.group(side + "_arm"), nullptr);
    EXPECT_EQ(semantics.group(side + "_arm")->coordinates.size(), 7u);
    EXPECT_EQ(semantics.group(side + "_hand")->coordinates.size(), 1u);
    ASSERT_NE(semantics.state(side + "_arm", "home"), nullptr);
    EXPECT_EQ(semantics.state(side + "_arm", "home")->values.size(), 7u);
  }
  EXPECT_EQ(semantics.end_effectors.size(), 2u);
  EXPECT_EQ(semantics.group("both_arms")->coordinates.size(), 14u);
}

TEST(TwoArms, WhenOneSideIsMirrored_ThenItIsTheOther) {
  const Robot robot = tests::two_arms();
  const auto mirrored = [](std::string name) {
    return name.starts_with("left") ? "right" + name.substr(4) : name;
  };
  for (const Joint& joint : robot.joints) {
    if (!joint.name.starts_with("left")) continue;
    const Joint& other = robot.joints[static_cast<std::size_t>(robot.joint(mirrored(joint.name)))];
    EXPECT_EQ(joint.axis, other.axis) << joint.name;
    EXPECT_EQ(joint.origin.position_m.y,
              joint.name == "left_joint_1" ? -other.origin.position_m.y : other.origin.position_m.y);
    EXPECT_EQ(joint.origin.position_m.z, other.origin.position_m.z);
    if (joint.coordinate < 0) continue;
    const Coordinate& a = robot.coordinates[static_cast<std::size_t>(joint.coordinate)];
    const Coordinate& b = robot.coordinates[static_cast<std::size_t>(other.coordinate)];
    EXPECT_EQ(a.lower, b.lower);
    EXPECT_EQ(a.upper, b.upper);
    EXPECT_EQ(a.velocity_per_s, b.velocity_per_s);
  }
}

}  // namespace
}  // namespace stepwright::motion
