#include "supervisor/motion/robot/urdf_reader.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

std::string robot_text(const std::string& members) {
  return "<robot name=\"r\">\n" + members + "\n</robot>";
}
const std::string kTwoLinks = R"(<link name="a"/> <link name="b"/>)";
std::string jointed(const std::string& type, const std::string& inside) {
  return robot_text(kTwoLinks + "\n<joint name=\"j\" type=\"" + type +
                    R"("><parent link="a"/><child link="b"/>)" + inside + "</joint>");
}

// "line:column CODE" of each message.
std::vector<std::string> urdf_errors(const std::string& text) {
  const auto robot = read_urdf(text, "r.urdf");
  std::vector<std::string> found;
  if (robot) return found;
  for (const auto& each : robot.error()) {
    EXPECT_EQ(each.where.file, "r.urdf");
    EXPECT_FALSE(each.message.empty());
    found.push_back(std::to_string(each.where.line) + ":" + std::to_string(each.where.column) + " " +
                    each.code);
  }
  return found;
}
using Errors = std::vector<std::string>;

TEST(UrdfReader, WhenLinksComeInAnyOrder_ThenParentsStandBeforeTheirChildren) {
  const auto robot = read_urdf(robot_text(R"(
    <link name="tip"/> <link name="mid"/> <link name="root"/> <link name="side"/>
    <joint name="last" type="continuous"><parent link="mid"/><child link="tip"/><axis xyz="0 0 2"/></joint>
    <joint name="first" type="prismatic"><parent link="root"/><child link="mid"/>
      <origin xyz="1 2. +3" rpy="0 0 1.5707963267948966"/><limit lower="-0.1" upper="0.2" velocity="0.5"/></joint>
    <joint name="beside" type="fixed"><parent link="root"/><child link="side"/></joint>)"),
                               "r.urdf");
  ASSERT_TRUE(robot) << to_string(robot.error());
  ASSERT_EQ(robot->links.size(), 4u);
  EXPECT_EQ(robot->links[0].name, "root");
  for (int j = 0; j < 3; ++j) EXPECT_LE(robot->joints[static_cast<std::size_t>(j)].parent, j);
  const int last = robot->joint("last");
  EXPECT_EQ(robot->links[static_cast<std::size_t>(Robot::link_below(last))].name, "tip");
  EXPECT_EQ(robot->parent_link(robot->link("tip")), robot->link("mid"));
  EXPECT_EQ(robot->joints[static_cast<std::size_t>(last)].axis, (Vector3{0, 0, 1}));
  EXPECT_TRUE(robot->hangs_below(robot->link("tip"), robot->link("root")));
  EXPECT_FALSE(robot->hangs_below(robot->link("side"), robot->link("mid")));
  ASSERT_EQ(robot->coordinates.size(), 2u);
  const Coordinate& first = robot->coordinates[static_cast<std::size_t>(robot->coordinate("first"))];
  EXPECT_EQ(first.lower, -0.1);
  EXPECT_EQ(first.upper, 0.2);
  EXPECT_EQ(first.velocity_per_s, 0.5);
  const Transform& origin = robot->joints[static_cast<std::size_t>(robot->joint("first"))].origin;
  EXPECT_EQ(origin.position_m, (Vector3{1, 2, 3}));
  EXPECT_LT(distance(origin.rotation * Vector3{1, 0, 0}, {0, 1, 0}), 1e-15);
}

TEST(UrdfReader, WhenJointsMimicOneAnother_ThenOneCoordinateMovesThemAll) {
  const auto robot = read_urdf(robot_text(R"(
    <link name="a"/><link name="b"/><link name="c"/><link name="d"/>
    <joint name="third" type="revolute"><parent link="a"/><child link="d"/><mimic joint="second" multiplier="2" offset="1"/></joint>
    <joint name="first" type="continuous"><parent link="a"/><child link="b"/></joint>
    <joint name="second" type="revolute"><parent link="a"/><child link="c"/><mimic joint="first" multiplier="-3" offset="0.5"/></joint>)"),
                               "r.urdf");
  ASSERT_TRUE(robot) << to_string(robot.error());
  ASSERT_EQ(robot->coordinates.size(), 1u);
  const Joint& third = robot->joints[static_cast<std::size_t>(robot->joint("third"))];
  EXPECT_EQ(third.coordinate, 0);
  EXPECT_EQ(third.multiplier, -6.0);  // 2 (-3 v + 0.5) + 1
  EXPECT_EQ(third.offset, 2.0);
}

TEST(UrdfReader, WhenLinksHaveBodies_ThenTheyAreReadWithTheirPlaces) {
  const auto robot = read_urdf(robot_text(R"(<link name="a">
    <visual><geometry><mesh filename="seen.dae"/></geometry></visual>
    <collision><origin xyz="0 0 1"/><geometry><box size="1 2 3"/></geometry></collision>
    <collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision>
    <collision><geometry><sphere radius="0.25"/></geometry></collision>
    <collision><geometry><mesh filename="package://p/m.stl" scale="0.001 0.001 0.001"/></geometry></collision></link>)"),
                               "r.urdf");
  ASSERT_TRUE(robot) << to_string(robot.error());
  const auto& shapes = robot->links[0].shapes;
  ASSERT_EQ(shapes.size(), 4u);
  EXPECT_EQ(shapes[0].size_m, (Vector3{1, 2, 3}));
  EXPECT_EQ(shapes[0].origin.position_m, (Vector3{0, 0, 1}));
  EXPECT_EQ(shapes[1].kind, ShapeKind::Cylinder);
  EXPECT_EQ(shapes[1].length_m, 2.0);
  EXPECT_EQ(shapes[2].radius_m, 0.25);
  EXPECT_EQ(shapes[3].mesh, "package://p/m.stl");
  EXPECT_EQ(shapes[3].scale.y, 0.001);
}

TEST(UrdfReader, WhenItIsNoXml_ThenTheErrorHasItsPlace) {
  EXPECT_EQ(urdf_errors("<robot name=\"r\">\n <link"), Errors{"2:6 A0101"});
  EXPECT_EQ(urdf_errors("").size(), 1u);
  EXPECT_EQ(urdf_errors("<!DOCTYPE robot [<!ENTITY x \"y\">]><robot/>").front().substr(0, 2), "1:");
  std::string deep;
  for (int k = 0; k < 70; ++k) deep += "<a>";
  for (int k = 0; k < 70; ++k) deep += "</a>";
  EXPECT_EQ(urdf_errors(robot_text(deep)).front().substr(0, 2), "2:");
  EXPECT_EQ(urdf_errors("<sdf version='1'/>"), Errors{"1:2 A0102"});
  EXPECT_EQ(urdf_errors("<robot name='r'/>"), Errors{"1:2 A0102"});
}

TEST(UrdfReader, WhenNumbersAreWrong_ThenAllAreToldAtOnceWhereTheyStand) {
  EXPECT_EQ(urdf_errors(robot_text(R"(<link name="a"><collision>
<origin xyz="1 2" rpy="0 0 x"/>
<geometry><cylinder length="-1" radius="nan"/></geometry></collision></link>)")),
            (Errors{"3:19 A0102", "3:9 A0102", "4:33 A0103", "4:21 A0103"}));
  EXPECT_EQ(urdf_errors(robot_text("<link name=\"a\"><collision><geometry/></collision></link>")),
            Errors{"2:28 A0102"});
  EXPECT_EQ(urdf_errors(robot_text("<link name='a'/><link name='a'/><link/>")),
            (Errors{"2:23 A0102", "2:34 A0102"}));
  EXPECT_EQ(urdf_errors(jointed("revolute", "<axis xyz='0 0 0'/><limit lower='1' upper='-1'/>")),
            (Errors{"3:74 A0103", "3:94 A0103"}));
}

TEST(UrdfReader, WhenJointsMoveWithoutLimits_ThenTheyAreRefused) {
  EXPECT_EQ(urdf_errors(jointed("revolute", "")), Errors{"3:2 A0106"});
  EXPECT_EQ(urdf_errors(jointed("prismatic", "<limit upper='1' effort='1'/>")), Errors{"3:70 A0106"});
  EXPECT_EQ(urdf_errors(jointed("continuous", "")), Errors{});
  EXPECT_EQ(urdf_errors(jointed("floating", "")), Errors{"3:17 A0109"});
}

TEST(UrdfReader, WhenNamesAreUnknown_ThenTheNearestIsProposed) {
  const auto robot = read_urdf(robot_text(R"(<link name="base"/><link name="arm"/>
<joint name="j" type="fixed"><parent link="bse"/><child link="arm"/></joint>)"),
                               "r.urdf");
  ASSERT_FALSE(robot);
  EXPECT_EQ(robot.error()[0].code, "A0104");
  EXPECT_EQ(robot.error()[0].where.line, 3u);
  EXPECT_EQ(robot.error()[0].where.column, 38u);
  EXPECT_EQ(robot.error()[0].hint, "did you mean 'base'?");
  EXPECT_EQ(urdf_errors(jointed("continuous", "<mimic joint='k'/>")), Errors{"3:2 A0104"});
}

TEST(UrdfReader, WhenLinksAreNoTree_ThenTheCauseIsSaid) {
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "\n<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>";
  };
  const std::string links = "<link name='a'/><link name='b'/><link name='c'/>";
  EXPECT_EQ(
      urdf_errors(robot_text(links + joint("1", "a", "b") + joint("2", "b", "c") + joint("3", "a", "c"))),
      Errors{"5:2 A0105"});  // two parents
  EXPECT_EQ(urdf_errors(robot_text(links + joint("1", "b", "c") + joint("2", "c", "b"))),
            Errors{"4:2 A0105"});
  EXPECT_EQ(
      urdf_errors(robot_text(links + joint("1", "a", "b") + joint("2", "b", "c") + joint("3", "c", "a"))),
      Errors{"5:2 A0105"});                                                                // no root
  EXPECT_EQ(urdf_errors(robot_text(links + joint("1", "a", "b"))), Errors{"2:34 A0105"});  // two roots
  EXPECT_EQ(
      urdf_errors(robot_text(links + joint("1", "a", "a") + joint("2", "a", "b") + joint("3", "b", "c")))
          .front(),
      "3:2 A0105");
  EXPECT_EQ(urdf_errors(jointed("continuous", "<mimic joint='j'/>")), Errors{"3:2 A0105"});
}

TEST(UrdfReader, WhenARobotIsDrawnInMillimetres_ThenTheHintSaysSo) {
  const auto robot = read_urdf(jointed("fixed", "<origin xyz='0 0 500'/>"), "r.urdf");
  ASSERT_FALSE(robot);
  EXPECT_EQ(robot.error()[0].code, "A0108");
  EXPECT_EQ(robot.error()[0].where.line, 3u);
  EXPECT_NE(robot.error()[0].hint.find("millimetres"), std::string::npos);
  EXPECT_EQ(urdf_errors(jointed("revolute", "<limit lower='-170' upper='170'/>")), Errors{"3:69 A0108"});
  EXPECT_EQ(urdf_errors(robot_text(
                "<link name='a'><collision><geometry><sphere radius='80'/></geometry></collision></link>")),
            Errors{"2:45 A0108"});
}

TEST(UrdfReader, WhenThereIsMoreThanIsRead_ThenItIsRefused) {
  std::string links;
  for (int k = 0; k < 1100; ++k) links += "<link name='l" + std::to_string(k) + "'/>";
  const auto errors = urdf_errors(robot_text(links));
  ASSERT_FALSE(errors.empty());
  EXPECT_NE(errors.front().find("A0107"), std::string::npos);
}

TEST(UrdfReader, WhenARobotOfOthersIsThere_ThenItIsRead) {
  const auto panda = tests::data_of_others("arms/panda/panda.urdf");
  const auto ur5 = tests::data_of_others("arms/ur5/ur5.urdf");
  if (!panda || !ur5) GTEST_SKIP() << "data/arms is not on this machine";
  const Robot arm = tests::robot_of(*panda);
  EXPECT_EQ(arm.coordinates.size(), 7u);  // its fingers are fixed
  EXPECT_EQ(
      tests::semantics_of(panda->parent_path() / "panda.srdf", arm).group("panda_arm")->coordinates.size(),
      7u);
  const Robot other = tests::robot_of(*ur5);
  EXPECT_EQ(other.coordinates.size(), 6u);
  EXPECT_EQ(tests::semantics_of(ur5->parent_path() / "ur5.srdf", other).states.size(), 3u);
  EXPECT_FALSE(tests::robot_of(panda->parent_path() / "panda_spherized.urdf").links.empty());
  EXPECT_FALSE(tests::robot_of(ur5->parent_path() / "ur5_spherized.urdf").links.empty());
}

}  // namespace
}  // namespace stepwright::motion
