// When conditions of transitions are evaluated: sfc_semantics.md, "Conditions". What is in them must not
// happen while their transition is not enabled.

#include <gtest/gtest.h>

#include "ladder/lowering/condition_guard.h"
#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/unit/ladder/lowering/chart_builder.h"
#include "tests/unit/ladder/lowering/chart_run.h"

namespace stepwright::lowering {
namespace {

using Traces = std::vector<std::string>;

constexpr const char* kCount =
    "FUNCTION Count : BOOL\nVAR_IN_OUT n : INT; END_VAR VAR_INPUT v : BOOL; END_VAR\n"
    "n := n + 1; Count := v;\nEND_FUNCTION\n";

// SFC-C-1
TEST(SfcCondition, WhenAStepSetsWhatItsConditionDividesBy_ThenItDoesNotTrapBefore) {
  ChartRun run(
      "VAR d : INT; ok : BOOL; END_VAR\n"
      "INITIAL_STEP S0: END_STEP STEP S1: prep(N); END_STEP STEP S2: ok(N); END_STEP\n"
      "TRANSITION FROM S0 TO S1 := go; END_TRANSITION\n"
      "TRANSITION FROM S1 TO S2 := 10 / d > 2; END_TRANSITION ACTION prep: d := 2; END_ACTION");
  EXPECT_EQ(run.traces({"main.d", "main.ok"}, "000100"), (Traces{"000222", "000011"}));
}

// SFC-C-1
TEST(SfcCondition, WhenATransitionIsNotEnabled_ThenNoIndexConversionOrReferenceTraps) {
  for (const char* condition : {"a[r1] > 0", "p^", "REAL_TO_INT(big) > 1", "SQRT(x) > 0.0", "NOT (s[i] = c)",
                                "d <> 3 AND (10 / d) = 5"}) {
    ChartRun run(
        std::string("VAR a : ARRAY[1..3] OF INT; r1, d, lim : INT; p : REF_TO BOOL; big : REAL := 1.0E30; "
                    "x : REAL := -1.0; s : STRING[5]; i : INT; c : CHAR; END_VAR\n"
                    "INITIAL_STEP S0: END_STEP STEP S1: END_STEP STEP S2: END_STEP\n"
                    "TRANSITION FROM S0 TO S1 := go; END_TRANSITION\n"
                    "TRANSITION FROM S1 TO S2 := ") +
        condition + "; END_TRANSITION");
    for (int scan = 0; scan < 3; ++scan) EXPECT_FALSE(run.program().scan().trap) << condition;
    run.program().set("main.go", 1);
    EXPECT_FALSE(run.program().scan().trap) << condition;
    EXPECT_TRUE(run.program().scan().trap) << condition;
  }
}

// SFC-C-2
TEST(SfcCondition, WhenAConditionHasEffects_ThenTheyHappenWhileItsTransitionIsEnabled) {
  ChartRun run(
      "VAR n0, n1, n2 : INT; END_VAR\n"
      "INITIAL_STEP S0: END_STEP STEP S1: END_STEP STEP S2: END_STEP STEP S3: END_STEP\n"
      "TRANSITION FROM S0 TO (S1, S2) := Count(n := n0, v := go); END_TRANSITION\n"
      "TRANSITION FROM S1 TO S3 := Count(n := n1, v := r); END_TRANSITION\n"
      "TRANSITION FROM (S2, S3) TO S0 := Count(n := n2, v := go); END_TRANSITION",
      kCount);
  EXPECT_EQ(run.traces({"main.n0", "main.n1", "main.n2"}, "00010000100", "00000010000"),
            (Traces{"01233333345", "00001233333", "00000001222"}));
}

// SFC-C-3
TEST(SfcCondition, WhenAPriorTransitionFires_ThenTheNextOneIsNotTested) {
  ChartRun run(
      "VAR d, n : INT; END_VAR\n"
      "INITIAL_STEP S0: END_STEP STEP S1: q(N); END_STEP STEP S2: END_STEP STEP S3: END_STEP\n"
      "TRANSITION FROM S0 TO S1 := d = 0; END_TRANSITION\n"
      "TRANSITION FROM S0 TO S2 := 10 / d > 20; END_TRANSITION\n"
      "TRANSITION (PRIORITY := 2) FROM S1 TO S3 := Count(n := n, v := TRUE); END_TRANSITION\n"
      "TRANSITION (PRIORITY := 1) FROM S1 TO S2 := go; END_TRANSITION",
      kCount);
  EXPECT_EQ(run.traces({"main.q", "main.n"}, "0010"), (Traces{"0100", "0000"}));
}

// SFC-C-4
TEST(SfcCondition, WhenOneConditionChangesWhatAnotherReads_ThenThoseThatGoFirstAreSeen) {
  ChartRun run(
      "VAR n : INT; ob, oc : BOOL; END_VAR\n"
      "INITIAL_STEP I: END_STEP STEP A: END_STEP STEP A2: ob(N); END_STEP STEP B: END_STEP STEP B2: oc(N); "
      "END_STEP\nTRANSITION FROM I TO (A, B) := TRUE; END_TRANSITION\n"
      "TRANSITION (PRIORITY := 1) FROM A TO A2 := n = 1; END_TRANSITION\n"
      "TRANSITION FROM B TO B2 := Count(n := n, v := go); END_TRANSITION",
      kCount);
  EXPECT_EQ(run.traces({"main.n", "main.ob", "main.oc"}, "0001"), (Traces{"0012", "0011", "0001"}));
}

// SFC-C-1
TEST(SfcCondition, WhenTheChartIsABlock_ThenTheSameHolds) {
  ChartRun run("VAR f : Sub; END_VAR f(); mark := 0;",
               "FUNCTION_BLOCK Sub\nVAR d : DINT; END_VAR VAR_OUTPUT ok : BOOL; END_VAR\n"
               "INITIAL_STEP S0: END_STEP STEP S1: prep(N); END_STEP STEP S2: ok(N); END_STEP\n"
               "TRANSITION FROM S0 TO S1 := TRUE; END_TRANSITION\n"
               "TRANSITION FROM S1 TO S2 := 10 / d > 2; END_TRANSITION ACTION prep: d := 2; END_ACTION\n"
               "END_FUNCTION_BLOCK\n");
  EXPECT_EQ(run.trace("main.f.ok", "000"), "001");
}

TEST(SfcCondition, WhenItIsEvaluatedAndTraps_ThenTheTrapHasItsPlaceAndNothingFires) {
  ChartRun run(
      "VAR d : INT; END_VAR\nINITIAL_STEP S0: END_STEP STEP S1: END_STEP\n"
      "TRANSITION t FROM S0 TO S1 := 10 / d > 2; END_TRANSITION");
  EXPECT_FALSE(run.program().scan().trap);
  const auto report = run.program().scan();
  const auto trap = reader::describe(run.program().loaded().program(), report.trap);
  EXPECT_EQ(trap.code, "R0401");
  EXPECT_EQ(trap.where.line, 5U);
  EXPECT_EQ(trap.where.column, 36U);
  EXPECT_EQ(run.program().get("main.t_FIRES"), 0);
}

// What cannot be told from an evaluation in every scan stays one rung of contacts, as in Figure 14.
TEST(SfcCondition, WhenItOnlyReads_ThenItStandsInSeriesWithTheStep) {
  for (const char* text :
       {"go", "NOT go AND (n > -3)", "a.b.Q & S1.X", "{@1:2}x{@} <= T#5s", "%IX0.1 OR y", "+1 < n", "TRUE"})
    EXPECT_TRUE(only_reads(std::string_view(text))) << text;
  for (const char* text : {"f(x)", "a[1]", "10 / d > 2", "n - 1 > 2", "n MOD 2 = 0", "p^ > 1", "f (x)",
                           "s = 'a'", "x (* c *)", "a ** 2.0 > 1.0", "NOT ABS(x) > 1", "(a) - 1 > 3"})
    EXPECT_FALSE(only_reads(std::string_view(text))) << text;
}

TEST(SfcCondition, WhenItIsGuarded_ThenItsRungHasThePowerOfTheEnabledTransition) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true), step("B")};
  graphic::Condition quotient;
  quotient.kind = graphic::ConditionKind::Expression;
  quotient.name = "10 / d > 2";
  chart.transitions = {transition("T0", {0}, {1}, graphic::contact("x")),
                       transition("T1", {0}, {1}, quotient)};
  const auto lowered = lower_sfc(pou_of(chart, {"x"}));
  ASSERT_TRUE(lowered);
  const auto& rungs = std::get<graphic::LadderProgram>(lowered->body).rungs;
  EXPECT_EQ(rungs[1].condition, graphic::always());
  EXPECT_EQ(rungs[1].coils.at(0).kind, graphic::CoilKind::Reset);
  EXPECT_EQ(rungs[1].coils.at(0).variable, "T1_FIRES");
  EXPECT_EQ(graphic::to_st(rungs[2].condition), "A_X AND NOT T0_FIRES");
  EXPECT_EQ(rungs[2].blocks.at(0).st_body, "T1_FIRES := (10 / d > 2);");
}

}  // namespace
}  // namespace stepwright::lowering
