// `stepwright arm ROBOT.urdf SCENE REQUEST` as a user runs it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/command_run.h"

namespace stepwright::arm_test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kCell = STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/";

class ArmCommand : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright", "arm " + arguments); }
  // With the robot's own files, but for what is given.
  int plan(const std::string& more, const std::string& scene = kCell + "table.toml",
           const std::string& request = kCell + "swing.yaml") {
    return run(kCell + "two_arms.urdf " + scene + " " + request + " --srdf " + kCell +
               "two_arms.srdf --protrusion 0.06 " + more);
  }
  static std::string content(const std::string& file) {
    std::ostringstream in;
    in << std::ifstream(kCell + file).rdbuf();
    return in.str();
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }
};

TEST_F(ArmCommand, WhenAPathIsFound_ThenSummaryJsonAndPictureAgreeAndASeedHasOnePath) {
  ASSERT_EQ(plan("--json " + path("a.json") + " --svg " + path("a.svg")), 0) << errors << output;
  EXPECT_THAT(output, HasSubstr("path of right_arm: "));
  EXPECT_THAT(output, HasSubstr("planned in "));
  EXPECT_THAT(output, HasSubstr(" motions are free as a whole, by the bodies themselves"));
  const auto json = nlohmann::json::parse(text("a.json"));
  EXPECT_EQ(json["found"], true);
  EXPECT_EQ(json["joints"].size(), 7u);
  EXPECT_EQ(json["path"].front(), json["from"]);
  EXPECT_EQ(json["path"].back(), json["to"]);
  EXPECT_EQ(json["recheck"]["motions"].get<std::size_t>() + 1, json["path"].size());
  EXPECT_EQ(json["to"][0], -1.2);
  EXPECT_THAT(text("a.svg"), HasSubstr("class=\"side\""));
  EXPECT_THAT(text("a.svg"), HasSubstr("class=\"top\""));
  EXPECT_THAT(text("a.svg"), HasSubstr("<title>crate</title>"));
  ASSERT_EQ(plan("--json -"), 0);
  EXPECT_EQ(nlohmann::json::parse(output)["path"], json["path"]) << "nothing else on standard output";
}

TEST_F(ArmCommand, WhenAPlannerIsNamed_ThenItPlansOrTheListIsSaid) {
  ASSERT_EQ(plan("--planner KPIECE1 --seed 3 --json " + path("k.json")), 0) << errors << output;
  EXPECT_THAT(output, HasSubstr(" by KPIECE1 "));
  EXPECT_EQ(nlohmann::json::parse(text("k.json"))["planner"], "KPIECE1");
  EXPECT_EQ(plan("--planner KPIECE"), 1);
  EXPECT_THAT(errors,
              HasSubstr("A0701: there is no planner 'KPIECE'\n  hint: did you mean 'KPIECE1'? There are "
                        "stepwright, RRTConnect, "));
}

TEST_F(ArmCommand, WhenAnEndCannotBe_ThenTheCauseIsSaid) {
  // A post where the hand is to be.
  const std::string request = content("swing.yaml");
  EXPECT_EQ(plan("", "", write("far.yaml", replaced(request, "position: -1.2", "position: -2.2"))), 2);
  EXPECT_EQ(plan("", kCell + "table.toml",
                 write("far.yaml", replaced(request, "position: -1.2", "position: -2.2"))),
            3)
      << errors;
  EXPECT_THAT(output,
              HasSubstr("cannot be done: the goal is beyond a limit: 'right_joint_1' is -2.2000, and goes "
                        "from -2.0944 to 2.0944"));
  const std::string wall = "[[box]]\nname = \"wall\"\nat_m = [0, -0.6, 1.2]\nsize_m = [1.2, 0.6, 2.4]\n";
  EXPECT_EQ(plan("--json " + path("c.json"), write("wall.toml", wall)), 3) << errors;
  EXPECT_THAT(output, HasSubstr("' meets 'wall'"));
  const auto json = nlohmann::json::parse(text("c.json"));
  EXPECT_EQ(json["found"], false);
  EXPECT_EQ(json["proved"], true);
  EXPECT_THAT(json["cause"].get<std::string>(), HasSubstr("the start collides: '"));
}

TEST_F(ArmCommand, WhenFilesAreWrong_ThenEveryMistakeHasItsPlace) {
  EXPECT_EQ(plan("", path("none.toml")), 1);
  EXPECT_THAT(errors, HasSubstr("none.toml"));
  EXPECT_EQ(
      plan("", write("units.toml", replaced(content("table.toml"), "[0.8, 1.4, 0.04]", "[800, 1400, 40]"))),
      1);
  EXPECT_THAT(errors, HasSubstr("units.toml:6:10: A0601: 'size_m' is 800 m, further than 50 m"));
  EXPECT_EQ(plan("", kCell + "table.toml",
                 write("g.yaml", replaced(content("swing.yaml"), "right_arm", "rigth_arm"))),
            1);
  EXPECT_THAT(errors, HasSubstr("A0404: the robot has no group 'rigth_arm' that moves\n  hint: did you mean "
                                "'right_arm'?"));
  EXPECT_EQ(run(write("mm.urdf", replaced(content("two_arms.urdf"), "xyz=\"0 0 0.20\"", "xyz=\"0 0 200\"")) +
                " " + kCell + "table.toml " + kCell + "swing.yaml"),
            1);
  EXPECT_THAT(errors, HasSubstr("A0108"));
  EXPECT_EQ(run(write("mesh.urdf",
                      "<robot name='r'><link name='a'><collision><geometry><mesh "
                      "filename='gone.stl'/></geometry></collision></link></robot>") +
                " " + kCell + "table.toml " + kCell + "swing.yaml"),
            1);
  EXPECT_THAT(errors, HasSubstr("mesh.urdf:1:"));
  EXPECT_THAT(errors, HasSubstr("A0110: the mesh 'gone.stl' of link 'a' is not found"));
  EXPECT_EQ(plan("", write("allowed.toml", content("table.toml") +
                                               "\n[[allowed]]\nlink = \"rigth_hand\"\nthing = \"tabel\"\n")),
            1);
  EXPECT_THAT(errors, HasSubstr("A0404: there is no link 'rigth_hand'\n  hint: did you mean 'right_hand'?"));
  EXPECT_THAT(errors, HasSubstr("A0404: there is no thing 'tabel'\n  hint: did you mean 'table'?"));
  EXPECT_EQ(plan("", write("mesh.toml", "[[mesh]]\nname = \"m\"\nfile = \"gone.stl\"\nat_m = [1, 0, 0]\n")),
            1);
  EXPECT_THAT(errors, HasSubstr("mesh.toml:3:"));
  EXPECT_THAT(errors, HasSubstr("A0201: 'gone.stl': "));
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(plan("--time nan"), 2);
  EXPECT_EQ(plan("--seed -1"), 2);
  EXPECT_EQ(plan("--json /nowhere/f.json"), 1);
}

TEST_F(ArmCommand, WhenThingsStandInEachOther_ThenBothAreNamedAndAPathIsPlanned) {
  const std::string sunk = replaced(content("table.toml"), "[0.62, 0.25, 0.76]", "[0.62, 0.25, 0.7]");
  EXPECT_EQ(plan("--json " + path("s.json"), write("sunk.toml", sunk)), 0) << output;
  EXPECT_THAT(errors, HasSubstr("A0604: 'table' and 'can' stand in each other"));
  EXPECT_EQ(errors.find("sunk.toml: "), std::string::npos) << "the place is a line: " << errors;
  EXPECT_EQ(nlohmann::json::parse(text("s.json"))["warnings"][0]["code"], "A0604");
}

TEST_F(ArmCommand, WhenThereIsNoSrdf_ThenTheJointsOfTheGoalAreTheGroup) {
  // A finger's neighbours of neighbours touch: without SRDF that is told.
  const std::string robot = R"(<robot name="r"><link name="a"/>
    <link name="b"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
    <joint name="slide" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-2" upper="2"/></joint></robot>)";
  const std::string request =
      "group_name: any\nstart_state: {joint_state: {name: [slide], position: [-1]}}\n"
      "goal_constraints: [{joint_constraints: [{joint_name: slide, position: 1}]}]\n";
  EXPECT_EQ(run(write("r.urdf", robot) + " " +
                write("e.toml",
                      "[[sphere]]\nname = \"ball\"\nat_m = [0, 1, 0]\n"
                      "radius_m = 0.1\n") +
                " " + write("r.yaml", request)),
            0)
      << errors;
  EXPECT_THAT(output, HasSubstr("2 way-points, length 2.000"));
  EXPECT_EQ(run(path("r.urdf") + " " +
                write("w.toml", "[[box]]\nname = \"wall\"\nat_m = [0, 0, 0]\nsize_m = [0.1, 1, 1]\n") + " " +
                path("r.yaml") + " --time 0.1"),
            4)
      << output;
  EXPECT_THAT(output, HasSubstr("no path: "));
}

// One joint that slides, without SRDF.
TEST_F(ArmCommand, WhenASceneOfMoveItSaysMore_ThenItCounts) {
  const std::string robot = R"(<robot name="r"><link name="a"/>
    <link name="b"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
    <joint name="slide" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-2" upper="2"/></joint></robot>)";
  const std::string request =
      "group_name: any\ngoal_constraints: [{joint_constraints: [{joint_name: slide, position: 1}]}]\n";
  const std::string wall =
      "world: {collision_objects: [{id: wall, primitives: [{type: box, dimensions: [0.1, 1, 1]}], "
      "primitive_poses: [{position: {x: 1, y: 0, z: 0}}]}]}\n";
  const auto plan_in = [&](const std::string& scene, const std::string& json) {
    return run(write("r.urdf", robot) + " " + write("s.yaml", scene) + " " + write("r.yaml", request) +
               " --time 0.1 --json " + path(json));
  };
  EXPECT_EQ(plan_in(wall, "w.json"), 3);
  EXPECT_THAT(output, HasSubstr("the goal collides: 'b' meets 'wall'"));
  EXPECT_THAT(errors, HasSubstr("A0405: nothing says where 'slide' is at the start: 0 is taken"));
  // The matrix counts without SRDF, too; the state of the scene is the start.
  const std::string more =
      "allowed_collision_matrix: {entry_names: [b, wall], entry_values: [[false, true], [true, false]]}\n"
      "robot_state: {joint_state: {name: [slide], position: [-1.5]}}\n";
  EXPECT_EQ(plan_in(wall + more, "m.json"), 0) << output << errors;
  EXPECT_EQ(nlohmann::json::parse(text("m.json"))["from"][0], -1.5);
  EXPECT_EQ(errors.find("A0405"), std::string::npos);
  // A joint without ends goes the short way round.
  const std::string turning =
      "<robot name='r'><link name='a'/><link name='b'><collision><geometry><box size='0.1 0.1 "
      "0.1'/></geometry></collision></link><joint name='slide' type='continuous'><parent "
      "link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>";
  EXPECT_EQ(run(write("t.urdf", turning) + " " + write("e.yaml", "world: {collision_objects: []}\n") + " " +
                write("t.yaml",
                      "group_name: any\nstart_state: {joint_state: {name: [slide], position: [3]}}\n"
                      "goal_constraints: [{joint_constraints: [{joint_name: slide, position: -3}]}]\n")),
            0)
      << errors;
  EXPECT_THAT(output, HasSubstr("length 0.283"));
  const std::string bare =
      "<robot name='r'><link name='a'/><link name='b'/><joint name='slide' type='prismatic'>"
      "<parent link='a'/><child link='b'/><limit lower='-2' upper='2'/></joint></robot>";
  EXPECT_EQ(run(write("bare.urdf", bare) + " " + path("s.yaml") + " " + path("r.yaml") + " --time 0.1"), 0);
  EXPECT_THAT(errors, HasSubstr("A0114: no link that moves has a body"));
}

}  // namespace
}  // namespace stepwright::arm_test
