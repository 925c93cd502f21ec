// `stepwright tamp PROBLEM.toml` as a user runs it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

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

}  // namespace
}  // namespace stepwright::tamp_test
