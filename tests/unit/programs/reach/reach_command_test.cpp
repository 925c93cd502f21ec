// `stepwright reach SEQUENCE.toml` as a user runs it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/command_run.h"

namespace stepwright::reach_test {
namespace {

using testing::HasSubstr;

constexpr const char* kCells = STEPWRIGHT_SOURCE_DIR "/tests/cells/reach/";

class ReachCommand : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright", "reach " + arguments); }

  // One arm, one tray, one cup; then more.
  std::string file(const std::string& more) {
    return write(
        "cell.toml",
        "[[arm]]\nname = \"right\"\nz_m = 0.5\ncell_m = 0.1\n"
        "[[grasp]]\nname = \"top\"\nheight_m = 0.3\n"
        "[[region]]\nname = \"tray\"\nx_m = 0.5\ny_m = 0.2\nz_m = 0.1\nsize_x_m = 0.2\nsize_y_m = 0.2\n"
        "[[object]]\nname = \"cup\"\nx_m = 0.5\ny_m = -0.2\nz_m = 0.1\n" +
            more);
  }
};

TEST_F(ReachCommand, WhenASequenceIsFeasible_ThenRangesJsonAndPictureAgree) {
  ASSERT_EQ(
      run(std::string(kCells) + "two_arms.toml --json " + path("reach.json") + " --svg " + path("cell.svg")),
      0)
      << errors;
  EXPECT_THAT(output, HasSubstr("5 left places cup1 on tray1\n    x 0.4000 .. 0.7000 m"));
  const auto json = nlohmann::json::parse(text("reach.json"));
  EXPECT_EQ(json["feasible"], true);
  EXPECT_EQ(json["proved"], true);
  ASSERT_EQ(json["actions"].size(), 5u);
  EXPECT_EQ(json["actions"][2].size(), 1u) << "a hand that moves away has no pose";
  EXPECT_NEAR(json["actions"][4]["x_m"][0].get<double>(), 0.4, 1e-9);
  EXPECT_NEAR(std::abs(json["actions"][4]["object_deg"][0][0].get<double>()), 180.0, 1e-6);
  EXPECT_THAT(text("cell.svg"), HasSubstr("tray1 (0.05 m)"));
  EXPECT_THAT(text("cell.svg"), HasSubstr("class=\"left\""));
  ASSERT_EQ(run(std::string(kCells) + "two_arms.toml --json -"), 0);
  EXPECT_EQ(nlohmann::json::parse(output), json) << "nothing else on standard output";
}

TEST_F(ReachCommand, WhenItCannotBeDone_ThenTheCauseIsSaidAndItsValueWouldDo) {
  ASSERT_EQ(run(std::string(kCells) + "too_high.toml --json " + path("reach.json")), 3) << errors;
  EXPECT_THAT(output, HasSubstr("cannot be done: tray1 is "));
  EXPECT_THAT(output, HasSubstr(" mm too high for the left arm"));
  EXPECT_THAT(output, HasSubstr("these conflict, and no part of them does:\n"));
  const auto json = nlohmann::json::parse(text("reach.json"));
  EXPECT_EQ(json["feasible"], false);
  const auto& cause = json["cause"];
  EXPECT_EQ(cause["irreducible"], true);
  EXPECT_FALSE(cause["constraints"].empty());
  const double height_m = cause["suggestions"][0]["to_m"].get<double>();
  EXPECT_EQ(cause["suggestions"][0]["from_m"], 0.955);
  // And it does: in the file, instead of what is there.
  std::string changed = [&] {
    std::ostringstream in;
    in << std::ifstream(std::string(kCells) + "too_high.toml").rdbuf();
    return in.str();
  }();
  const std::size_t at = changed.find("0.955");
  ASSERT_NE(at, std::string::npos);
  changed.replace(at, 5, std::to_string(height_m));
  EXPECT_EQ(run(write("lower.toml", changed)), 0) << output << errors;
}

TEST_F(ReachCommand, WhenTheFileIsWrong_ThenEveryMistakeHasItsPlace) {
  EXPECT_EQ(run(path("none.toml")), 1);
  EXPECT_THAT(errors, HasSubstr("I0001"));
  EXPECT_EQ(
      run(file("[[action]]\narm = \"rigth\"\npick = \"cup\"\n[[action]]\narm = \"right\"\nplace = \"cup\"\n"
               "on = \"trey\"\nangle = 5\n[[region]]\nname = \"cup\"\n")),
      1);
  EXPECT_THAT(errors, HasSubstr("cell.toml:21:7: I0103: there is no 'rigth'\n  hint: did you mean 'right'?"));
  EXPECT_THAT(errors, HasSubstr("I0103: there is no 'trey'"));
  EXPECT_THAT(errors, HasSubstr("I0002: unknown key 'action.angle'"));
  EXPECT_THAT(errors, HasSubstr("I0104: 'cup' is used twice"));
  EXPECT_THAT(errors, HasSubstr("I0005"));
  EXPECT_EQ(run(file("[[action]]\narm = \"right\"\nplace = \"cup\"\non = \"tray\"\n")), 1);
  EXPECT_THAT(errors, HasSubstr("cell.toml:20:1: I0102: action 1: arm 'right' does not hold 'cup'"));
  EXPECT_EQ(run(file("[[action]]\narm = \"right\"\n")), 1);
  EXPECT_THAT(errors, HasSubstr("an action has one of pick, place and move_away"));
  EXPECT_EQ(run(file("[[arm]]\nname = \"long\"\nmost_m = 4.9\ncell_m = 0.005\n")), 1);
  EXPECT_THAT(errors, HasSubstr("too many cells"));
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run(file("") + " --json /nowhere/f.json"), 1);
  EXPECT_EQ(run(file("")), 0) << "nothing to do is done";
  EXPECT_THAT(output, HasSubstr("there are no actions"));
}

TEST_F(ReachCommand, WhenAnArmIsThatOfAUrdf_ThenItsReachCounts) {
  ASSERT_EQ(run(std::string(kCells) + "own_arms.toml"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("2 right places can on shelf\n    x 0.3500 .. 0.5500 m"));
  std::ostringstream in;
  in << std::ifstream(std::string(kCells) + "own_arms.toml").rdbuf();
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = in.str();
    const std::string folder = "../robot_cell/";
    other.replace(other.find(folder), folder.size(), STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/");
    const std::size_t at = other.find(from);
    return write("changed.toml", at == std::string::npos ? "" : other.replace(at, from.size(), to));
  };
  EXPECT_EQ(run(changed("x_m = 0.45", "x_m = 1.45")), 3) << "a shelf that is too far";
  EXPECT_THAT(output, HasSubstr("shelf is "));
  EXPECT_THAT(output, HasSubstr(" mm too far towards +x for the right arm"));
  EXPECT_EQ(run(changed("right_tcp", "right_hand_tip")), 1);
  EXPECT_THAT(errors, HasSubstr("I0103: the robot has no link 'right_hand_tip'"));
  EXPECT_EQ(run(changed("right_tcp", "right_flange")), 0) << errors;
  EXPECT_EQ(run(changed("right_tcp", "right_wrist")), 1);
  EXPECT_THAT(errors, HasSubstr("I0105: no bounds are made of this arm"));
  EXPECT_EQ(run(changed("two_arms.urdf", "two_arms.srdf")), 1);
  EXPECT_THAT(errors, HasSubstr("A010"));
  EXPECT_EQ(run(changed("two_arms.urdf", "none.urdf")), 1);
  EXPECT_THAT(errors, HasSubstr("none.urdf' cannot be read"));
}

// What would do is put into the file, and the arm reaches it for certain.
TEST_F(ReachCommand, WhenAPoseOfAUrdfIsOutOfReach_ThenWhatWouldDoIsReached) {
  const auto pick_at = [&](const std::string& x, const std::string& y, const std::string& z) {
    return run(
        write("pick.toml", "[[arm]]\nname = \"right\"\nurdf = \"" STEPWRIGHT_SOURCE_DIR
                           "/tests/cells/robot_cell/two_arms.urdf\"\nbase = \"base\"\ntip = \"right_tcp\"\n"
                           "[[grasp]]\nname = \"top\"\nheight_m = 0.1\n[[object]]\nname = \"can\"\nx_m = " +
                               x + "\ny_m = " + y + "\nz_m = " + z +
                               "\n[[action]]\narm = \"right\"\npick = \"can\"\n") +
        " --json " + path("pick.json"));
  };
  ASSERT_EQ(pick_at("0.5", "0.5", "0.71"), 3) << output;
  const auto suggestions = nlohmann::json::parse(text("pick.json"))["cause"]["suggestions"];
  ASSERT_FALSE(suggestions.empty()) << output;
  for (const auto& each : suggestions) {
    const std::string said = each["text"].get<std::string>(),
                      value = std::to_string(each["to_m"].get<double>());
    const auto if_at = [&](const char* where, const char* else_at) {
      return said.find(where) == std::string::npos ? std::string(else_at) : value;
    };
    EXPECT_EQ(pick_at(if_at(" x ", "0.5"), if_at(" y ", "0.5"), if_at("height", "0.71")), 0) << said;
    EXPECT_EQ(nlohmann::json::parse(text("pick.json"))["reached"], true) << said;
  }
  // Within the bounds, and not within reach.
  ASSERT_EQ(pick_at("0.5", "0.3", "0.71"), 0) << output;
  EXPECT_THAT(output, HasSubstr("no poses were found that the arms reach for certain"));
  EXPECT_EQ(nlohmann::json::parse(text("pick.json"))["reached"], false);
}

TEST_F(ReachCommand, WhenAskedForBlocks_ThenAProgramThatCallsThemCompiles) {
  ASSERT_EQ(run(std::string(kCells) + "own_arms.toml --st " + path("reach.st")), 0) << errors;
  const std::string block = text("reach.st");
  EXPECT_THAT(block, HasSubstr("FUNCTION_BLOCK right_REACH\n"));
  const std::string program = write("main.st", block + R"(
PROGRAM main
VAR here : right_REACH; END_VAR
  here(X := 0.45, Y := -0.3, Z := 0.92, Angle := 0.5);
END_PROGRAM
)");
  EXPECT_EQ(run_program("stepwright", "compile --check " + program), 0) << output << errors;
  ASSERT_EQ(run(std::string(kCells) + "own_arms.toml --st -"), 0);
  EXPECT_EQ(output, block) << "nothing else on standard output";
}

TEST_F(ReachCommand, WhenObjectsAreStackedAndLieBeyondOthers_ThenTheyAreRead) {
  const std::string second = "[[object]]\nname = \"can\"\nx_m = 0.4\ny_m = 0.0\nz_m = 0.1\nheight_m = 0.12\n";
  const auto action = [](const std::string& rest) { return "[[action]]\narm = \"right\"\n" + rest; };
  EXPECT_EQ(run(file(second + action("pick = \"cup\"\n") + action("place = \"cup\"\non = \"can\"\n"))), 0)
      << errors;
  EXPECT_THAT(output, HasSubstr("z 0.2200 .. 0.2200 m"));
  const std::string far =
      action("pick = \"cup\"\n") +
      action(
          "place = \"cup\"\non = \"tray\"\nbeyond = [{object = \"can\", direction_deg = 90, "
          "distance_m = 0.25}]\n");
  ASSERT_EQ(run(file(second + far)), 0) << output;
  EXPECT_THAT(output, HasSubstr("y 0.2500 .. 0.3000 m"));
  std::string further = second + far;
  further.replace(further.find("0.25}"), 4, "0.35");
  EXPECT_EQ(run(file(further)), 3);
  EXPECT_THAT(output, HasSubstr("the distance between cup and can is 50.1 mm too large"));
}

}  // namespace
}  // namespace stepwright::reach_test
