// `stepwright htn` as a user runs it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/command_run.h"

namespace stepwright::htn_test {
namespace {

using testing::HasSubstr;

constexpr const char* kFolder = STEPWRIGHT_SOURCE_DIR "/tests/cells/htn/";

class HtnCommand : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright", arguments); }
  static std::string files(const std::string& problem) {
    return std::string(kFolder) + "two_arms.hddl " + kFolder + problem + ".hddl --time 600 ";
  }
};

constexpr const char* kOutside =
    "--external can-move-pick --external is-picked --external can-move-place --external is-placed --external "
    "can-move-away --external is-away ";

TEST_F(HtnCommand, WhenTheProblemIsSolved_ThenPlanTreeAndFiguresAreWritten) {
  ASSERT_EQ(
      run("htn " + files("d1") + kOutside + "--json " + path("plan.json") + " --out " + path("plan.txt")), 0)
      << errors;
  EXPECT_THAT(output, HasSubstr("(pick left top cup2)\n(place left red-region cup2)\n"));
  EXPECT_THAT(output, HasSubstr("; 4 steps, cost 0;"));
  const auto json = nlohmann::json::parse(text("plan.json"));
  EXPECT_EQ(json["outcome"], "solved");
  EXPECT_EQ(json["plan_steps"], 4);
  EXPECT_EQ(json["plan"][0], "(pick left top cup2)");
  EXPECT_EQ(json["tree"]["roots"].size(), 2u);
  EXPECT_THAT(text("plan.txt"), HasSubstr("-> with-one-arm"));
}

TEST_F(HtnCommand, WhenThereIsNoPlan_ThenThatIsProvedAndTold) {
  // Without the one who judges them, the geometric facts never hold.
  EXPECT_EQ(run("htn " + files("d1") + "--json " + path("plan.json")), 3);
  EXPECT_THAT(errors, HasSubstr("no plan exists: every decomposition was tried"));
  EXPECT_THAT(errors, HasSubstr("has no further way: no method can be applied"));
  EXPECT_EQ(nlohmann::json::parse(text("plan.json"))["outcome"], "infeasible");
}

TEST_F(HtnCommand, WhenTheInputIsWrong_ThenItsPlaceIsTold) {
  const std::string wrong =
      write("wrong.hddl",
            "(define (problem p)\n  (:domain two-arms)\n  (:htn :subtasks (and (put a b) (put b a))))\n");
  EXPECT_EQ(run("htn " + std::string(kFolder) + "two_arms.hddl " + wrong), 1);
  EXPECT_THAT(errors, HasSubstr("wrong.hddl:3:9: P0602"));
  EXPECT_EQ(run("htn " + files("d1") + "--external can-fly"), 1);
  EXPECT_THAT(errors, HasSubstr("P0607"));
  EXPECT_EQ(run("htn nothing.hddl " + wrong), 1);
  EXPECT_EQ(run("htn"), 2);
  EXPECT_EQ(run("htn " + files("d1") + "--time soon"), 2);
}

}  // namespace
}  // namespace stepwright::htn_test
