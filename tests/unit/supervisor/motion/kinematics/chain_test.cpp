#include "supervisor/motion/kinematics/chain.h"

#include <gtest/gtest.h>

#include "supervisor/motion/kinematics/link_frames.h"
#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::motion {
namespace {

std::vector<double> draw_configuration(const Robot& robot, Random& random) {
  std::vector<double> q;
  for (const Coordinate& each : robot.coordinates)
    q.push_back(random.between(std::max(each.lower, -3.0), std::min(each.upper, 3.0)));
  return q;
}

// URDF's meaning word for word: one matrix after the other.
Transform place_by_definition(const Robot& robot, int link, const std::vector<double>& q) {
  if (link == 0) return {};
  const Joint& joint = robot.joints[static_cast<std::size_t>(Robot::joint_above(link))];
  Transform motion;
  if (joint.coordinate >= 0) {
    const double value = joint.multiplier * q[static_cast<std::size_t>(joint.coordinate)] + joint.offset;
    if (joint.kind == JointKind::Prismatic)
      motion.position_m = value * joint.axis;
    else
      motion.rotation = about(joint.axis, value);
  }
  return place_by_definition(robot, joint.parent, q) * joint.origin * motion;
}

TEST(LinkFrames, WhenARobotTakesAConfiguration_ThenEachLinkIsWhereUrdfPutsIt) {
  const Robot robot = tests::two_arms();
  const LinkFrames kinematics(robot);
  std::vector<Transform> frames(robot.links.size());
  Random random(4);
  for (int k = 0; k < 200; ++k) {
    const auto q = draw_configuration(robot, random);
    kinematics.place(q, frames);
    for (std::size_t link = 0; link < frames.size(); ++link)
      ASSERT_LT(tests::off(frames[link], place_by_definition(robot, static_cast<int>(link), q)), 1e-13)
          << robot.links[link].name;
  }
}

TEST(LinkFrames, WhenAFingerMimicsTheOther_ThenTheyOpenTogether) {
  const Robot robot = tests::two_arms();
  std::vector<Transform> frames(robot.links.size());
  std::vector<double> q(robot.coordinates.size());
  q[static_cast<std::size_t>(robot.coordinate("right_gripper"))] = 0.03;
  LinkFrames(robot).place(q, frames);
  const auto place = [&](const char* link) {
    return frames[static_cast<std::size_t>(robot.link(link))].position_m;
  };
  EXPECT_NEAR(distance(place("right_finger_1"), place("right_finger_2")), 0.06, 1e-15);
  EXPECT_NEAR(distance(place("left_finger_1"), place("left_finger_2")), 0.0, 1e-15);
}

TEST(Chain, WhenItGoesThroughFixedJoints_ThenItsTipIsWhereTheWholeRobotHasIt) {
  const Robot robot = tests::two_arms();
  const LinkFrames kinematics(robot);
  const Chain arm = tests::chain_of(robot, "torso", "right_tcp");
  ASSERT_EQ(arm.size(), 7u);
  std::vector<Transform> frames(robot.links.size());
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const auto q = draw_configuration(robot, random);
    kinematics.place(q, frames);
    std::vector<double> own;
    for (const ChainJoint& joint : arm.joints()) own.push_back(q[static_cast<std::size_t>(joint.coordinate)]);
    ASSERT_LT(tests::off(arm.forward(own), frames[static_cast<std::size_t>(robot.link("right_tcp"))]), 1e-13);
    EXPECT_TRUE(arm.within_limits(own));
  }
}

TEST(Chain, WhenJointsMoveALittle_ThenTheJacobianSaysHowTheTipMoves) {
  const auto robot =
      read_urdf(R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
    <joint name="1" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.1 0.2 0.3" rpy="0.5 0.1 -0.4"/>
      <axis xyz="1 2 -1"/><limit lower="-1" upper="1"/></joint>
    <joint name="2" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0.4 0" rpy="1 0 0"/>
      <axis xyz="0 1 1"/><limit lower="-1" upper="1"/></joint>
    <joint name="3" type="continuous"><parent link="c"/><child link="d"/><origin xyz="0.3 0 0.1"/><axis xyz="0 0 1"/></joint></robot>)",
                "r.urdf");
  ASSERT_TRUE(robot) << to_string(robot.error());
  const Chain chain = tests::chain_of(*robot, "a", "d");
  ASSERT_EQ(chain.size(), 3u);
  Random random(6);
  for (int k = 0; k < 100; ++k) {
    std::vector<double> q{random.between(-1, 1), random.between(-1, 1), random.between(-3, 3)};
    std::vector<double> columns(18);
    const Transform tip = chain.jacobian(q, columns);
    for (std::size_t j = 0; j < 3; ++j) {
      constexpr double kStep = 1e-6;
      std::vector<double> moved = q;
      moved[j] += kStep;
      const Transform there = chain.forward(moved);
      const Vector3 speed = (1 / kStep) * (there.position_m - tip.position_m);
      const Vector3 spin = (1 / kStep) * rotation_vector(there.rotation * transposed(tip.rotation));
      ASSERT_LT(distance(speed, {columns[6 * j], columns[6 * j + 1], columns[6 * j + 2]}), 1e-5);
      ASSERT_LT(distance(spin, {columns[6 * j + 3], columns[6 * j + 4], columns[6 * j + 5]}), 1e-5);
    }
  }
}

TEST(Chain, WhenTheTipHangsElsewhere_ThenItIsRefused) {
  const Robot robot = tests::two_arms();
  const auto code_of = [&](const char* base, const char* tip) {
    const auto chain = Chain::between(robot, robot.link(base), robot.link(tip));
    return chain ? "" : chain.error()[0].code;
  };
  EXPECT_EQ(code_of("left_tcp", "torso"), "A0111");
  EXPECT_EQ(code_of("left_wrist", "right_tcp"), "A0111");
  EXPECT_EQ(code_of("torso", "none"), "A0111");
  EXPECT_EQ(code_of("base", "torso"), "A0111");               // nothing moves
  EXPECT_EQ(code_of("left_hand", "left_finger_2"), "A0111");  // mimics
}

}  // namespace
}  // namespace stepwright::motion
