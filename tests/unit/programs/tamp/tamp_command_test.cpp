// `stepwright tamp PROBLEM.toml` as a user runs it.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/command_run.h"

namespace stepwright::tamp_test {
namespace {

using testing::HasSubstr;

constexpr const char* kCells = STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/";

class TampCommand : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright", "tamp " + arguments); }
};

TEST_F(TampCommand, WhenAProblemIsSolved_ThenActionsJsonAndPictureAgree) {
  ASSERT_EQ(run(std::string(kCells) + "tamp_p2.toml --json " + path("p.json") + " --svg " + path("p.svg")), 0)
      << errors;
  EXPECT_THAT(
      output,
      HasSubstr(
          "right picks can1\nright places can1 on tray\nright picks can2\nright places can2 on tray\n"));
  const auto json = nlohmann::json::parse(text("p.json"));
  EXPECT_EQ(json["outcome"], "solved");
  ASSERT_EQ(json["plan"].size(), 4u);
  EXPECT_EQ(json["plan"][1]["region"], "tray");
  EXPECT_EQ(json["plan"][1]["motions"][0]["phase"], "lift");
  EXPECT_EQ(json["plan"][1]["motions"][0]["path"][0].size(), 7u);
  EXPECT_THAT(text("p.svg"), HasSubstr("<polyline"));
}

TEST_F(TampCommand, WhenTheFileIsWrong_ThenItSaysWhere) {
  EXPECT_EQ(run(write("cell.toml", "grasps = 0\n")), 1);
  EXPECT_THAT(errors, HasSubstr("cell.toml:1:"));
  EXPECT_THAT(errors, HasSubstr("G0004"));
  EXPECT_EQ(run(std::string(kCells) + "tamp_p2.toml --method theirs"), 2);
}

// P2 beside its own HDDL, with parts of both replaced.
class ChangedTamp : public TampCommand {
 protected:
  int run_changed(const std::vector<std::pair<std::string, std::string>>& in_cell,
                  const std::vector<std::pair<std::string, std::string>>& in_problem) {
    const std::string root = STEPWRIGHT_SOURCE_DIR "/tests/cells/";
    std::string cell = content(root + "robot_cell/tamp_p2.toml"),
                problem = content(root + "robot_cell/p2.hddl");
    for (const auto& [from, to] : in_cell) replace(cell, from, to);
    for (const auto& [from, to] : in_problem) replace(problem, from, to);
    replace(cell, "robot = \"", "robot = \"" + root + "robot_cell/");
    replace(cell, "semantics = \"", "semantics = \"" + root + "robot_cell/");
    replace(cell, "domain = \"../htn/", "domain = \"" + root + "htn/");
    replace(cell, "problem = \"p2.hddl", "problem = \"problem.hddl");
    write("problem.hddl", problem);
    return run(write("cell.toml", cell) + " --time 20");
  }

  static std::string content(const std::string& file) {
    std::ostringstream in;
    in << std::ifstream(file).rdbuf();
    return in.str();
  }
  static void replace(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
};

TEST_F(ChangedTamp, WhenTheProblemNamesWhatTheCellHasNot_ThenItSaysWhereAndWhatWasMeant) {
  ASSERT_EQ(run_changed({}, {}), 0) << errors;
  EXPECT_EQ(run_changed({}, {{"can2 - thing", "can2 can9 - thing"}}), 1);
  EXPECT_THAT(errors, HasSubstr("problem.hddl:"));
  EXPECT_THAT(errors, HasSubstr("G0104: the cell has no thing 'can9'\n  hint: did you mean 'can1'?"));
  EXPECT_EQ(run_changed({}, {{"right left - arm", "right left mid - arm"}}), 1);
  EXPECT_THAT(errors, HasSubstr("G0104: the cell has no arm 'mid'"));
  EXPECT_EQ(
      run_changed({}, {{"tray - place", "tray shelf - place"}, {"(put can1 tray)", "(put can1 shelf)"}}), 1);
  EXPECT_THAT(errors, HasSubstr("G0104: the cell has no region or thing 'shelf'"));
  EXPECT_EQ(run_changed({}, {{"tray - place", "tray shelf - place"}}), 0)
      << "nothing is to be put there: " << errors;
}

TEST_F(ChangedTamp, WhenAProblemInPddlNamesWhatTheCellHasNot_ThenItSaysWhereAndWhatWasMeant) {
  std::string cell = content(std::string(kCells) + "tamp_p1_pddl.toml"),
              problem = content(std::string(kCells) + "p1.pddl");
  for (const char* key : {"robot", "semantics", "domain"})
    replace(cell, std::string("\n") + key + " = \"", std::string("\n") + key + " = \"" + kCells);
  replace(cell, "problem = \"p1.pddl", "problem = \"problem.pddl");
  replace(problem, "right left - arm top - grasp cup1 - thing",
          "right left mid - arm top - grasp cup1 cup2 - thing");
  write("problem.pddl", problem);
  EXPECT_EQ(run(write("cell.toml", cell)), 1);
  EXPECT_THAT(errors, HasSubstr("problem.pddl:5:24: G0104: the cell has no arm 'mid'"));
  EXPECT_THAT(errors, HasSubstr("G0104: the cell has no thing 'cup2'\n  hint: did you mean 'cup1'?"));
}

TEST_F(ChangedTamp, WhenWhatIsSaidOfTheStartIsNotSo_ThenItIsToldAtItsPlace) {
  EXPECT_EQ(run_changed({}, {{"(in can1 table)", "(in can1 tray)"}}), 1);
  EXPECT_THAT(errors, HasSubstr("problem.hddl:"));
  EXPECT_THAT(errors, HasSubstr("G0105: 'can1' does not stand on 'tray' at first"));
  (void)run_changed({{"y_m = -0.48\nz_m = 0.7\n", "y_m = -0.48\nz_m = 0.75\n"}}, {});
  EXPECT_THAT(errors, HasSubstr("cell.toml:"));
  EXPECT_THAT(errors, HasSubstr("warning: G0106: 'can1' hangs 50.0 mm above what is below it"));
}

// What would do, does: put into the file, it has a plan.
TEST_F(ChangedTamp, WhenATrayIsTooFar_ThenWhatWouldDoHasAPlan) {
  const std::string far = "name = \"tray\"\nx_m = 0.5\ny_m = 0.9\n",
                    tray = "name = \"tray\"\nx_m = 0.5\ny_m = -0.25\n";
  ASSERT_EQ(run_changed({{tray, far}}, {}), 3) << output;
  const std::size_t at = errors.find("; tray at y ");
  ASSERT_NE(at, std::string::npos) << errors;
  EXPECT_THAT(errors, HasSubstr(" m would do"));
  const std::string value = errors.substr(at + 12, errors.find(" m would do") - at - 12);
  EXPECT_EQ(run_changed({{tray, "name = \"tray\"\nx_m = 0.5\ny_m = " + value + "\n"}}, {}), 0)
      << value << errors;
}

}  // namespace
}  // namespace stepwright::tamp_test
