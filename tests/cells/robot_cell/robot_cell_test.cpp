// The robot cell's plant with the real commands: by_hand.st moves the arms, the judge says what came of it.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <thread>

#include "runtime/service/connection.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"

namespace stepwright::cells {
namespace {

using support::kPatience;
using support::TestProcess;

class RobotCellByHand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string file(const std::string& name) {
    return STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/" + name;
  }
  std::string options(const std::string& more) const {
    return " --config " + file("by_hand.toml") + " --set cell.state_dir=" + path("state") + more;
  }
  int run(const std::string& arguments) {
    const std::string line = STEPWRIGHT_BIN_DIR "/stepwright " + arguments + " >" + path("said") + " 2>&1";
    const int status = std::system(line.c_str());
    std::stringstream text;
    text << std::ifstream(path("said")).rdbuf();
    said_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // Compiles, starts the runtime, downloads, runs until the program is done; the plant's truths then.
  std::map<std::string, double> driven(const std::string& fault = "") {
    std::map<std::string, double> truths;
    const std::string more = fault.empty() ? "" : " --set 'faults=[" + fault + "]'";
    EXPECT_EQ(run("check" + options(more)), 0) << said_;
    EXPECT_EQ(run("compile " + file("by_hand.st") + " -o " + path("by_hand.swb")), 0) << said_;
    const std::string stepwright = STEPWRIGHT_BIN_DIR "/stepwright";
    std::vector<std::string> line = {stepwright,           "runtime", "--config",
                                     file("by_hand.toml"), "--set",   "cell.state_dir=" + path("state")};
    if (!fault.empty()) line.insert(line.end(), {"--set", "faults=[" + fault + "]"});
    TestProcess runtime(line, path("runtime.log"));
    EXPECT_TRUE(runtime.wait_for("listens on")) << runtime.output();
    EXPECT_EQ(run("download" + options(more) + " " + path("by_hand.swb")), 0) << said_;
    EXPECT_EQ(run("start" + options(more)), 0) << said_;
    auto connection = service::Connection::open(path("state/runtime.sock"),
                                                {.role = service::Role::Observer, .name = "judge"});
    EXPECT_TRUE(connection) << result::to_string(connection.error());
    if (!connection) return truths;
    // 1288 scans of 10 ms; the plant rests when the program is done.
    for (const auto end = std::chrono::steady_clock::now() + kPatience;
         std::chrono::steady_clock::now() < end;) {
      const auto snapshot = (*connection)->snapshot();
      if (snapshot && snapshot->scan > kScans) {
        for (const auto& value : snapshot->plant) truths[value.name] = value.value;
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(run("snapshot" + options(more) + " Main.done Main.grasped"), 0) << said_;
    runtime.send(SIGTERM);
    EXPECT_EQ(runtime.wait(), 0) << runtime.output();
    return truths;
  }

  static constexpr std::uint64_t kScans = 1'500;
  const support::TemporaryFolder folder_;
  std::string said_;
};

TEST_F(RobotCellByHand, WhenTheProgramRuns_ThenTheCupStandsElsewhereAndTheJudgeHasSeenNothing) {
  auto truths = driven();
  EXPECT_NE(said_.find("TRUE"), std::string::npos) << said_;
  EXPECT_EQ(said_.find("FALSE"), std::string::npos) << said_;
  EXPECT_NEAR(truths["x_cup"], 0.50, 0.003);
  EXPECT_NEAR(truths["y_cup"], 0.50, 0.003);
  EXPECT_EQ(truths["z_cup"], 0.70);
  EXPECT_EQ(truths["on_cup"], 1.0);
  EXPECT_EQ(truths["y_can"], 0.0);
  for (const char* kind : {"contacts_arm_arm", "contacts_arm_fixed", "contacts_arm_object",
                           "contacts_object_object", "contacts_object_fixed", "dropped", "slipped"})
    EXPECT_EQ(truths[kind], 0.0) << kind;
  EXPECT_GT(truths["smallest_gap"], 0.05);
  EXPECT_LT(truths["worst_tilt"], 0.05);
}

TEST_F(RobotCellByHand, WhenTheHandLosesItsFriction_ThenTheJudgeSaysWhereTheCupFell) {
  auto truths = driven("{at_s=5.5,name=\"slip_left\",value=1.0}");
  EXPECT_EQ(truths["slipped"], 1.0);
  EXPECT_EQ(truths["dropped"], 1.0);
  EXPECT_EQ(truths["on_cup"], 1.0);  // the table
  EXPECT_GT(truths["y_cup"], 0.38);
  EXPECT_LT(truths["y_cup"], 0.50);
  EXPECT_EQ(truths["held_left"], 0.0);
}

TEST_F(RobotCellByHand, WhenTheCellIsWrong_ThenEachMistakeIsToldAtItsPlace) {
  EXPECT_EQ(run("check" + options(" --set plant.robot=none.urdf")), 1);
  EXPECT_NE(said_.find("C0006"), std::string::npos) << said_;
  EXPECT_EQ(run("check" + options(" --set plant.hand.friction=-1 --set plant.camera.loss=2")), 1);
  EXPECT_NE(said_.find("plant.hand.friction"), std::string::npos) << said_;
  EXPECT_NE(said_.find("plant.camera.loss"), std::string::npos) << said_;
  EXPECT_EQ(run("check" + options(" --set 'faults=[{at_s=1,name=\"slip_middle\",value=1}]'")), 1);
  EXPECT_NE(said_.find("C0311"), std::string::npos) << said_;
}

}  // namespace
}  // namespace stepwright::cells
