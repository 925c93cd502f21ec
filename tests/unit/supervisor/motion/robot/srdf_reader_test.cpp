#include "supervisor/motion/robot/srdf_reader.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

class SrdfOfTwoArms : public ::testing::Test {
 protected:
  result::Result<Semantics> read(const std::string& members) {
    return read_srdf("<robot name=\"r\">\n" + members + "</robot>", "r.srdf", robot_);
  }
  std::string first_error(const std::string& members) {
    const auto semantics = read(members);
    if (semantics) return "none";
    const auto& first = semantics.error().front();
    return std::to_string(first.where.line) + ":" + std::to_string(first.where.column) + " " + first.code +
           " " + first.hint;
  }

  Robot robot_ = tests::two_arms();
};

TEST_F(SrdfOfTwoArms, WhenAGroupIsAChain_ThenItHasTheJointsBetweenItsEnds) {
  const auto read = this->read(R"(<group name="arm"><chain base_link="torso" tip_link="left_tcp"/></group>)");
  ASSERT_TRUE(read) << to_string(read.error());
  const Group* arm = read->group("arm");
  ASSERT_NE(arm, nullptr);
  EXPECT_EQ(arm->coordinates.size(), 7u);
  EXPECT_EQ(arm->joints.size(), 9u);  // with two mounts
  EXPECT_EQ(arm->links.size(), 10u);
  EXPECT_EQ(arm->base_link, robot_.link("torso"));
  EXPECT_EQ(arm->tip_link, robot_.link("left_tcp"));
}

TEST_F(SrdfOfTwoArms, WhenAGroupHasLinksJointsAndGroups_ThenItHasEachOnce) {
  const auto read = this->read(R"(<group name="a"><link name="left_hand"/><joint name="left_gripper"/></group>
    <group name="b"><group name="a"/><joint name="left_gripper"/><joint name="left_gripper_mirrored"/></group>)");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->group("a")->links, (std::vector{robot_.link("left_hand"), robot_.link("left_finger_1")}));
  EXPECT_EQ(read->group("b")->coordinates, std::vector{robot_.coordinate("left_gripper")});
  EXPECT_EQ(read->group("b")->joints.size(), 3u);
  EXPECT_EQ(read->group("b")->base_link, -1);
}

TEST_F(SrdfOfTwoArms, WhenStatesAndHandsAndPairsAreGiven_ThenTheyAreRead) {
  const auto read = this->read(R"(<group name="g"><joint name="left_gripper"/></group>
    <group_state name="open" group="g"><joint name="left_gripper" value="0.0451"/><joint name="left_hand_mount" value="0"/></group_state>
    <end_effector name="hand" group="g" parent_link="left_flange"/>
    <disable_collisions link1="torso" link2="base" reason="Adjacent"/><disable_collisions link1="base" link2="torso"/>)");
  ASSERT_TRUE(read) << to_string(read.error());
  const NamedState* open = read->state("g", "open");
  ASSERT_NE(open, nullptr);
  EXPECT_EQ(open->values, (std::vector<std::pair<int, double>>{{robot_.coordinate("left_gripper"), 0.045}}));
  EXPECT_EQ(read->end_effectors.at(0).parent_link, robot_.link("left_flange"));
  EXPECT_EQ(read->disabled.size(), 1u);
  EXPECT_TRUE(read->is_disabled(robot_.link("torso"), robot_.link("base")));
  EXPECT_FALSE(read->is_disabled(robot_.link("torso"), robot_.link("left_wrist")));
}

TEST_F(SrdfOfTwoArms, WhenNamesAreWrong_ThenTheyAreToldWithTheirPlace) {
  EXPECT_EQ(first_error(R"(<group name="a"><link name="left_hnd"/></group>)"),
            "2:23 A0104 did you mean 'left_hand'?");
  EXPECT_EQ(first_error(R"(<group name="a"><joint name="x"/></group>)"), "2:24 A0104 ");
  EXPECT_EQ(first_error(R"(<group name="a"><group name="a"/></group>)").substr(0, 10), "2:24 A0104");
  EXPECT_EQ(first_error(R"(<group name="a"><thing name="x"/></group>)").substr(0, 10), "2:18 A0102");
  EXPECT_EQ(
      first_error(R"(<group name="a"><chain base_link="left_tcp" tip_link="torso"/></group>)").substr(0, 10),
      "2:18 A0111");
  EXPECT_EQ(first_error(R"(<group name="a"/><group name="a"/>)").substr(0, 10), "2:19 A0102");
  EXPECT_EQ(first_error(R"(<group name="arm"/><group_state name="s" group="amr"/>)"),
            "2:42 A0104 did you mean 'arm'?");
  EXPECT_EQ(
      first_error(
          R"(<group name="g"/><group_state name="s" group="g"><joint name="left_gripper" value="4.5"/></group_state>)")
          .substr(0, 10),
      "2:77 A0103");
  EXPECT_EQ(first_error("<group").substr(4, 5), "A0101");
}

}  // namespace
}  // namespace stepwright::motion
