#include "ladder/lowering/sfc_to_ladder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ladder/graphic/identifier.h"
#include "tests/support/ladder_evaluator.h"
#include "tests/unit/ladder/lowering/chart_builder.h"

namespace stepwright::lowering {
namespace {

using graphic::Qualifier;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Each rung as "condition -> coils", a coil with S or R in brackets.
std::vector<std::string> rungs_of(const graphic::Pou& pou) {
  std::vector<std::string> lines;
  for (const graphic::Rung& rung : std::get<graphic::LadderProgram>(pou.body).rungs) {
    std::string line = graphic::to_st(rung.condition) + " ->";
    for (const graphic::Coil& coil : rung.coils) {
      line += coil.kind == graphic::CoilKind::Set     ? " (S)"
              : coil.kind == graphic::CoilKind::Reset ? " (R)"
                                                      : " ";
      line += coil.variable;
    }
    lines.push_back(line);
  }
  return lines;
}

std::string first_error(const graphic::Pou& pou) {
  const result::Result<graphic::Pou> lowered = lower_sfc(pou);
  return lowered ? "lowered" : result::to_string(lowered.error().front());
}

// The paper's Figure 14: the initial step, LOAD until the level is reached, MOVE until the switch.
graphic::SfcChart figure_14() {
  graphic::SfcChart chart;
  chart.steps = {step("S0", true), step("LOAD", false, {{Qualifier::N, "B1"}}),
                 step("MOVE", false, {{Qualifier::N, "drive_left"}})};
  chart.transitions = {
      transition("T0", {0}, {1}, graphic::contact("fc1")),
      transition("T1", {1}, {2}, graphic::compare("S1", graphic::CompareOp::Greater, "3783")),
      transition("T2", {2}, {0}, graphic::contact("fc2"))};
  return chart;
}

TEST(SfcLowering, WhenChartIsFigure14_ThenRungsAreTransitionBitsResetsSetsOutputs) {
  const result::Result<graphic::Pou> lowered =
      lower_sfc(pou_of(figure_14(), {"fc1", "fc2", "B1", "drive_left"}));
  ASSERT_TRUE(lowered) << result::to_string(lowered.error());
  EXPECT_THAT(rungs_of(*lowered),
              ElementsAre("S0_X AND fc1 -> T0_FIRES", "LOAD_X AND (S1 > 3783) -> T1_FIRES",
                          "MOVE_X AND fc2 -> T2_FIRES", "T0_FIRES -> (R)S0_X", "T1_FIRES -> (R)LOAD_X",
                          "T2_FIRES -> (R)MOVE_X", "T0_FIRES -> (S)LOAD_X", "T1_FIRES -> (S)MOVE_X",
                          "T2_FIRES -> (S)S0_X", "SFC_FIRST_SCAN -> (S)S0_X", "LOAD_X -> B1",
                          "MOVE_X -> drive_left", "TRUE -> (R)SFC_FIRST_SCAN"));
  EXPECT_THAT(lowered->step_variables, ElementsAre("S0_X", "LOAD_X", "MOVE_X"));
  EXPECT_THAT(lowered->transition_variables, ElementsAre("T0_FIRES", "T1_FIRES", "T2_FIRES"));
  EXPECT_EQ(lowered->first_scan_variable, "SFC_FIRST_SCAN");
  EXPECT_EQ(lowered->origin.steps.size(), 3U);
}

TEST(SfcLowering, WhenTransitionsShareASource_ThenThePriorOneShutsTheOtherOut) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true), step("B"), step("C")};
  chart.transitions = {transition("T1", {0}, {1}, graphic::contact("i")),
                       transition("T2", {0}, {2}, graphic::contact("i"))};
  chart.transitions[0].priority = 2;
  chart.transitions[1].priority = 1;
  const result::Result<graphic::Pou> lowered = lower_sfc(pou_of(chart, {"i"}));
  ASSERT_TRUE(lowered);
  support::LadderEvaluator ladder(*lowered);
  ladder.scan(0);
  ladder.set("i", 1);
  ladder.scan(10);
  EXPECT_EQ(ladder.get("B_X"), 0);
  EXPECT_EQ(ladder.get("C_X"), 1);
}

TEST(SfcLowering, WhenFirstScanEnds_ThenInitialActionsRanBeforeAnyTransition) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true, {{Qualifier::N, "q"}}), step("B")};
  chart.transitions = {transition("T1", {0}, {1}, graphic::always())};
  const result::Result<graphic::Pou> lowered = lower_sfc(pou_of(chart, {"q"}));
  ASSERT_TRUE(lowered);
  support::LadderEvaluator ladder(*lowered);
  ladder.scan(0);
  EXPECT_EQ(ladder.get("q"), 1);
  EXPECT_EQ(ladder.get("A_X"), 1);
  ladder.scan(10);
  EXPECT_EQ(ladder.get("q"), 0);
  EXPECT_EQ(ladder.get("B_X"), 1);
}

TEST(SfcLowering, WhenStepIsLeftAndEnteredInOneScan_ThenItStaysActiveAndItsTimeRestarts) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true)};
  chart.transitions = {
      transition("T1", {0}, {0}, graphic::compare("A.T", graphic::CompareOp::GreaterEqual, "T#20ms"))};
  const result::Result<graphic::Pou> lowered = lower_sfc(pou_of(chart, {}));
  ASSERT_TRUE(lowered);
  support::LadderEvaluator ladder(*lowered);
  std::string times;
  for (int scan = 0; scan < 6; ++scan) {
    ladder.scan(scan * 10'000'000);
    EXPECT_EQ(ladder.get("A_X"), 1);
    times += std::to_string(ladder.get("A_T") / 10'000'000);
  }
  EXPECT_EQ(times, "010101");
}

TEST(SfcLowering, WhenBranchesConverge_ThenTheTransitionWaitsForAllSources) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true), step("B"), step("C"), step("D"), step("E")};
  chart.transitions = {transition("FORK", {0}, {1, 2}, graphic::always()),
                       transition("T1", {1}, {3}, graphic::contact("i")),
                       transition("JOIN", {3, 2}, {4}, graphic::always())};
  const result::Result<graphic::Pou> lowered = lower_sfc(pou_of(chart, {"i"}));
  ASSERT_TRUE(lowered);
  support::LadderEvaluator ladder(*lowered);
  for (int scan = 0; scan < 5; ++scan) ladder.scan(scan);
  EXPECT_EQ(ladder.get("B_X") + ladder.get("C_X"), 2);
  ladder.set("i", 1);
  ladder.scan(6);
  EXPECT_EQ(ladder.get("E_X"), 0);
  ladder.scan(7);
  EXPECT_EQ(ladder.get("E_X"), 1);
  EXPECT_EQ(ladder.get("C_X") + ladder.get("D_X"), 0);
}

TEST(SfcLowering, WhenNamesAreTakenByTheUser_ThenGeneratedNamesAreFreeAndLegal) {
  graphic::SfcChart chart = figure_14();
  chart.steps[1].actions.push_back({Qualifier::D, "motor.run", "T#1s", ""});
  chart.transitions[0].condition = graphic::contact("load_x");  // a global that this POU does not declare
  const result::Result<graphic::Pou> lowered = lower_sfc(pou_of(chart, {"s0_x", "B1", "drive_left", "fc2"}));
  ASSERT_TRUE(lowered);
  EXPECT_THAT(lowered->step_variables, ElementsAre("S0_X_2", "LOAD_X_2", "MOVE_X"));
  graphic::NameSet names;
  for (const graphic::Variable& variable : lowered->variables) {
    EXPECT_TRUE(graphic::is_identifier(variable.name)) << variable.name;
    EXPECT_TRUE(names.insert(variable.name)) << variable.name;
  }
  EXPECT_TRUE(names.contains("LOAD_motor_run_TMR"));
}

TEST(SfcLowering, WhenActionHasABody_ThenItRunsWithTheStepFlagsReplaced) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true, {{Qualifier::N, "WORK"}})};
  chart.actions = {{"WORK", "t := A.T; x := A.X;"}};
  const result::Result<graphic::Pou> lowered = lower_sfc(pou_of(chart, {"x"}));
  ASSERT_TRUE(lowered);
  const auto& rungs = std::get<graphic::LadderProgram>(lowered->body).rungs;
  const bool found = std::any_of(rungs.begin(), rungs.end(), [](const graphic::Rung& rung) {
    return rung.condition == graphic::contact("A_X") && !rung.blocks.empty() &&
           rung.blocks[0].st_body == "t := A_T; x := A_X;";
  });
  EXPECT_TRUE(found);
}

TEST(SfcLowering, WhenInputIsWrong_ThenTheDiagnosticNamesStepOrTransition) {
  graphic::SfcChart chart = figure_14();
  EXPECT_THAT(first_error(pou_of(chart, {"LOAD"})), HasSubstr("E0721: step 'LOAD'"));
  graphic::Pou pou = pou_of(chart, {});
  pou.variables.push_back({"B1", "INT"});
  EXPECT_THAT(first_error(pou), HasSubstr("E0722: target 'B1' of step 'LOAD' is a INT"));
  chart.transitions[1].targets.clear();
  EXPECT_THAT(first_error(pou_of(chart, {})), HasSubstr("transition 'T1' has no target step"));
  chart = figure_14();
  chart.actions = {{"STOP", "IF a THEN return; END_IF"}};
  EXPECT_THAT(first_error(pou_of(chart, {})), HasSubstr("E0724: RETURN in action 'STOP'"));
}

TEST(SfcLowering, WhenProjectLacksATarget_ThenTheDiagnosticNamesPouAndStep) {
  graphic::Project project;
  project.globals.push_back({"B1", "BOOL"});
  project.pous.push_back(pou_of(figure_14(), {}));
  const result::Result<graphic::Project> lowered = lower_sfc(project);
  ASSERT_FALSE(lowered);
  ASSERT_EQ(lowered.error().size(), 1U);
  EXPECT_EQ(lowered.error()[0].code, "E0723");
  EXPECT_THAT(lowered.error()[0].message, HasSubstr("POU 'main': target 'drive_left' of step 'MOVE'"));
}

TEST(SfcLowering, WhenProjectMixesBodies_ThenOnlyChartsChange) {
  graphic::Project project;
  project.globals = {{"B1", "BOOL"}, {"drive_left", "BOOL"}};
  project.pous.push_back(pou_of(figure_14(), {}));
  graphic::Pou st;
  st.name = "filter";
  st.body = graphic::StBody{"a := b;"};
  project.pous.push_back(st);
  const result::Result<graphic::Project> lowered = lower_sfc(project);
  ASSERT_TRUE(lowered);
  EXPECT_TRUE(std::holds_alternative<graphic::LadderProgram>(lowered->pous[0].body));
  EXPECT_TRUE(std::holds_alternative<graphic::StBody>(lowered->pous[1].body));
}

}  // namespace
}  // namespace stepwright::lowering
