// How tokens move, when bodies run and what flags say: sfc_semantics.md, compiled and run scan by scan.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/ladder/lowering/chart_run.h"

namespace stepwright::lowering {
namespace {

using ::testing::ElementsAre;
using Traces = std::vector<std::string>;

// SFC-M-1
TEST(SfcMatiecDefect, WhenPIsOnTheInitialStep_ThenItFires) {
  ChartRun run(
      "VAR n, m : INT; END_VAR\n"
      "INITIAL_STEP A: count(P); count1(P1); END_STEP STEP B: END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO A := go; END_TRANSITION\n"
      "ACTION count: n := n + 1; END_ACTION ACTION count1: m := m + 1; END_ACTION");
  EXPECT_EQ(run.traces({"main.n", "main.m"}, "0010100"), (Traces{"1111222", "1111222"}));
}

// SFC-M-2
TEST(SfcMatiecDefect, WhenTwoStepsHaveTheSamePAction_ThenItRunsForEach) {
  for (const char* pulse : {"P", "P1"}) {
    const std::string use = "count(" + std::string(pulse) + ");";
    ChartRun run("VAR n : INT; END_VAR\nINITIAL_STEP A: END_STEP STEP B: " + use +
                 " END_STEP STEP C: " + use +
                 " END_STEP\nTRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO C := go; "
                 "END_TRANSITION\nACTION count: n := n + 1; END_ACTION");
    EXPECT_EQ(run.trace("main.n", "0110000"), "0122222") << pulse;
  }
}

// SFC-M-3
TEST(SfcMatiecDefect, WhenBothConditionsOfASelectionAreTrue_ThenOnlyTheFirstBranchStarts) {
  ChartRun run(
      "VAR ob, oc : BOOL; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: ob(N); END_STEP STEP C: oc(N); END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM A TO C := go; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.ob", "main.oc"}, "0100"), (Traces{"0111", "0000"}));
}

// SFC-M-4
TEST(SfcMatiecDefect, WhenTheConditionIsTrueAtOnce_ThenTheInitialStepsActionsStillRan) {
  ChartRun run(
      "VAR n : INT; END_VAR\nINITIAL_STEP A: count(N); q(N); END_STEP STEP B: END_STEP\n"
      "TRANSITION FROM A TO B := TRUE; END_TRANSITION ACTION count: n := n + 1; END_ACTION");
  EXPECT_EQ(run.traces({"main.n", "main.q"}, "111"), (Traces{"111", "100"}));
}

// SFC-E-1
TEST(SfcEvolution, WhenAllConditionsAreTrue_ThenATokenMovesOneStepInAScan) {
  ChartRun run(
      "VAR oa, ob, oc : BOOL; END_VAR\n"
      "INITIAL_STEP A: oa(N); END_STEP STEP B: ob(N); END_STEP STEP C: oc(N); END_STEP\n"
      "TRANSITION FROM A TO B := TRUE; END_TRANSITION TRANSITION FROM B TO C := TRUE; END_TRANSITION\n"
      "TRANSITION FROM C TO A := TRUE; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.oa", "main.ob", "main.oc"}, "000000"), (Traces{"100100", "010010", "001001"}));
}

// SFC-E-2
TEST(SfcEvolution, WhenAConditionReadsAStepFlag_ThenItIsThatOfTheBeginningOfTheScan) {
  ChartRun run(
      "VAR ob : BOOL; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: ob(N); END_STEP INITIAL_STEP W: END_STEP STEP V: q(N); END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM W TO V := B.X; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.ob", "main.q"}, "00100"), (Traces{"00111", "00011"}));
}

// SFC-E-3
TEST(SfcEvolution, WhenTransitionsHavePriorities_ThenTheSmallerNumberGoesFirst) {
  ChartRun run(
      "VAR ob, oc, od : BOOL; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: ob(N); END_STEP STEP C: oc(N); END_STEP STEP D: od(N); END_STEP\n"
      "TRANSITION (PRIORITY := 3) FROM A TO B := go; END_TRANSITION\n"
      "TRANSITION t2 (PRIORITY := 1) FROM A TO C := go AND r; END_TRANSITION\n"
      "TRANSITION (PRIORITY := 2) FROM A TO D := go; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.ob", "main.oc", "main.od"}, "010", "010"), (Traces{"000", "011", "000"}));
}

// SFC-E-4
TEST(SfcEvolution, WhenOnlySomeHaveAPriority_ThenThoseWithoutGoFirst) {
  ChartRun run(
      "VAR ob : BOOL; END_VAR\nINITIAL_STEP A: END_STEP STEP B: ob(N); END_STEP STEP C: q(N); END_STEP\n"
      "TRANSITION (PRIORITY := 1) FROM A TO B := go; END_TRANSITION\n"
      "TRANSITION FROM A TO C := go; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.ob", "main.q"}, "010"), (Traces{"000", "011"}));
}

// SFC-E-5
TEST(SfcEvolution, WhenTheFirstTransitionLacksASource_ThenItDoesNotShutTheOtherOut) {
  ChartRun run(
      "VAR oc : BOOL; END_VAR\n"
      "INITIAL_STEP I: END_STEP STEP A: END_STEP STEP W: END_STEP STEP V: END_STEP STEP B: END_STEP\n"
      "STEP C: oc(N); END_STEP\n"
      "TRANSITION FROM I TO (A, W) := TRUE; END_TRANSITION\n"
      "TRANSITION FROM W TO V := r; END_TRANSITION\n"
      "TRANSITION FROM (A, V) TO B := TRUE; END_TRANSITION TRANSITION FROM A TO C := go; END_TRANSITION");
  EXPECT_EQ(run.trace("main.oc", "00010"), "00011");
}

// SFC-E-6
TEST(SfcEvolution, WhenBranchesAreSimultaneous_ThenTheyStartTogetherAndEndWhenAllAreThere) {
  ChartRun run(
      "VAR ob, oc, od : BOOL; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: ob(N); END_STEP STEP C: oc(N); END_STEP STEP D: od(N); END_STEP\n"
      "STEP E: q(N); END_STEP\n"
      "TRANSITION FROM A TO (B, C) := go; END_TRANSITION TRANSITION FROM B TO D := r; END_TRANSITION\n"
      "TRANSITION FROM (D, C) TO E := TRUE; END_TRANSITION TRANSITION FROM E TO A := go; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.ob", "main.oc", "main.od", "main.q"}, "0100000100", "0000100000"),
            (Traces{"0111000000", "0111100000", "0000100000", "0000011000"}));
}

// SFC-E-7
TEST(SfcEvolution, WhenAStepIsLeftAndEnteredInOneScan_ThenItStaysActiveButItsTimeStartsAgain) {
  ChartRun run(
      "VAR n, t, l : INT; END_VAR\nINITIAL_STEP A: count(P); q(L, T#30ms); clock(N); END_STEP\n"
      "TRANSITION FROM A TO A := go; END_TRANSITION\n"
      "ACTION count: n := n + 1; END_ACTION ACTION clock: t := TIME_TO_INT(A.T) / 10; END_ACTION");
  EXPECT_EQ(run.traces({"main.n", "main.q", "main.t"}, "001000"), (Traces{"111111", "111000", "010123"}));
}

// SFC-E-8
TEST(SfcEvolution, WhenThereAreSeveralInitialSteps_ThenEachHasItsToken) {
  ChartRun run(
      "VAR oa, ob : BOOL; END_VAR\n"
      "INITIAL_STEP A: oa(N); END_STEP STEP A2: END_STEP TRANSITION FROM A TO A2 := go; END_TRANSITION\n"
      "INITIAL_STEP B: ob(N); END_STEP STEP B2: END_STEP TRANSITION FROM B TO B2 := r; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.oa", "main.ob"}, "01000", "00010"), (Traces{"10000", "11100"}));
}

// SFC-E-9
TEST(SfcEvolution, WhenBodiesRun_ThenInTheOrderOfTheChartAndEachOnce) {
  ChartRun run(
      "VAR n, seen : INT; END_VAR\n"
      "INITIAL_STEP A: second(N); first(N); END_STEP INITIAL_STEP B: first(N); END_STEP\n"
      "ACTION first: n := n + 1; END_ACTION ACTION second: seen := n; END_ACTION");
  EXPECT_EQ(run.traces({"main.n", "main.seen"}, "000"), (Traces{"123", "123"}));
}

// SFC-E-10
TEST(SfcEvolution, WhenBranchesNestAndLoop_ThenTheTokensGoRound) {
  ChartRun run(
      "VAR n : INT; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP STEP L: n1(P); END_STEP STEP Z: n2(P); "
      "END_STEP\nSTEP D: END_STEP STEP E: END_STEP\n"
      "TRANSITION FROM A TO (B, C) := TRUE; END_TRANSITION\n"
      "TRANSITION FROM B TO L := go; END_TRANSITION TRANSITION FROM B TO Z := NOT go; END_TRANSITION\n"
      "TRANSITION FROM L TO D := TRUE; END_TRANSITION TRANSITION FROM Z TO B := r; END_TRANSITION\n"
      "TRANSITION FROM Z TO D := TRUE; END_TRANSITION TRANSITION FROM C TO E := TRUE; END_TRANSITION\n"
      "TRANSITION FROM (D, E) TO A := TRUE; END_TRANSITION\n"
      "ACTION n1: n := n + 1; END_ACTION ACTION n2: n := n + 3; END_ACTION");
  // A, fork, R, back to B, L, D, A ... : once 3, once 1.
  EXPECT_EQ(run.trace("main.n", "0000100", "0001000"), "0033444");
}

// SFC-E-11
TEST(SfcEvolution, WhenAFunctionBlockIsAChart_ThenEachInstanceHasItsOwnTokens) {
  ChartRun run("VAR f, g : Seq; END_VAR\nf(start := go); g(start := r); mark := 0;",
               "FUNCTION_BLOCK Seq\nVAR_INPUT start : BOOL; END_VAR VAR_OUTPUT lit : BOOL; n : INT; END_VAR\n"
               "INITIAL_STEP Idle: END_STEP STEP Busy: lit(L, T#20ms); count(P1); END_STEP\n"
               "TRANSITION FROM Idle TO Busy := start; END_TRANSITION\n"
               "TRANSITION FROM Busy TO Idle := Busy.T >= T#30ms; END_TRANSITION\n"
               "ACTION count: n := n + 1; END_ACTION\nEND_FUNCTION_BLOCK\n");
  EXPECT_EQ(run.traces({"main.f.lit", "main.g.lit", "main.f.n", "main.g.n"}, "01000000", "00010000"),
            (Traces{"01100000", "00011000", "01111111", "00011111"}));
}

// SFC-E-12
TEST(SfcEvolution, WhenABlockIsCalledTwiceInAScan_ThenEachCallIsOneScanOfItsChart) {
  ChartRun run(
      "VAR f : Seq; END_VAR\nIF go THEN f(); END_IF; IF r THEN f(); END_IF;",
      "FUNCTION_BLOCK Seq\nVAR_OUTPUT a, b, c, late : BOOL; END_VAR\n"
      "INITIAL_STEP S0: a(N); END_STEP STEP S1: b(N); END_STEP STEP S2: c(N); late(D, T#20ms); END_STEP\n"
      "TRANSITION FROM S0 TO S1 := TRUE; END_TRANSITION TRANSITION FROM S1 TO S2 := TRUE; END_TRANSITION\n"
      "END_FUNCTION_BLOCK\n");
  // The first call is the first scan, two calls are two scans, and the time goes on where there is none.
  EXPECT_EQ(run.traces({"main.f.a", "main.f.b", "main.f.c", "main.f.late"}, "01010001", "00010000"),
            (Traces{"01100000", "00000000", "00011111", "00000001"}));
}

// SFC-E-13
TEST(SfcEvolution, WhenAPriorityIsZero_ThenItIsThatOfATransitionWithoutOne) {
  ChartRun run(
      "VAR ob, oc, od : BOOL; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: ob(N); END_STEP STEP C: oc(N); END_STEP STEP D: od(N); END_STEP\n"
      "TRANSITION FROM A TO B := r; END_TRANSITION\n"
      "TRANSITION (PRIORITY := 0) FROM A TO C := go; END_TRANSITION\n"
      "TRANSITION FROM A TO D := go; END_TRANSITION");
  EXPECT_EQ(run.traces({"main.ob", "main.oc", "main.od"}, "010", "000"), (Traces{"000", "011", "000"}));
}

// SFC-F-1
TEST(SfcFlag, WhenAnotherActionReadsX_ThenItIsTheStepsState) {
  ChartRun run(
      "VAR seen : BOOL; END_VAR\nINITIAL_STEP A: END_STEP STEP B: END_STEP INITIAL_STEP W: watch(N); "
      "END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO A := go; END_TRANSITION\n"
      "ACTION watch: seen := b.x AND NOT A.X; END_ACTION");
  EXPECT_EQ(run.trace("main.seen", "0010010"), "0011100");
}

// SFC-F-2
TEST(SfcFlag, WhenTIsRead_ThenItCountsFromTheEntryAndKeepsItsValue) {
  ChartRun run(
      "VAR t : INT; END_VAR\nINITIAL_STEP A: END_STEP STEP B: END_STEP INITIAL_STEP W: watch(N); END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO A := go; END_TRANSITION\n"
      "ACTION watch: t := TIME_TO_INT(B.T) / 10; END_ACTION");
  EXPECT_EQ(run.trace("main.t", "0010010010"), "0001233301");
}

// SFC-F-3
TEST(SfcFlag, WhenQOfAnActionIsRead_ThenBodiesSeeThisScanAndTransitionsTheOneBefore) {
  ChartRun run(
      "VAR early : BOOL; END_VAR\n"
      "INITIAL_STEP A: END_STEP STEP B: work(D, T#20ms); END_STEP STEP C: q(N); END_STEP\n"
      "INITIAL_STEP W: watch(N); END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO C := work.Q; END_TRANSITION\n"
      "ACTION watch: early := work.Q; END_ACTION ACTION work: mark := 1; END_ACTION");
  EXPECT_EQ(run.traces({"main.early", "main.mark", "main.q"}, "0100000"),
            (Traces{"0001000", "0001000", "0000111"}));
}

// SFC-F-4
TEST(SfcFlag, WhenThereIsAFinalScan_ThenAIsTrueInItAndQIsNot) {
  ChartRun run(
      "VAR oa : BOOL; END_VAR\n{sfc_final_scan}\n"
      "INITIAL_STEP A: END_STEP STEP B: work(N); END_STEP INITIAL_STEP W: watch(N); END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO A := go; END_TRANSITION\n"
      "ACTION work: mark := 1; END_ACTION ACTION watch: oa := work.A; q := work.Q; END_ACTION");
  EXPECT_EQ(run.traces({"main.oa", "main.q", "main.mark"}, "0100100"),
            (Traces{"0111100", "0111000", "0111100"}));
}

// SFC-A-1
TEST(SfcAction, WhenTheDurationIsAVariable_ThenItsValueCounts) {
  ChartRun run(
      "VAR pt : TIME := T#30ms; s : Settings := (hold := T#20ms); ob : BOOL; END_VAR\n"
      "INITIAL_STEP A: q(L, pt); ob(L, s.hold); END_STEP",
      "TYPE Settings : STRUCT hold : TIME; END_STRUCT END_TYPE\n");
  EXPECT_EQ(run.traces({"main.q", "main.ob"}, "00000"), (Traces{"11100", "11000"}));
}

// SFC-A-2
TEST(SfcAction, WhenIndicatorsAreWritten_ThenTheyChangeNothing) {
  ChartRun run(
      "VAR ob, oc, done, fault : BOOL; END_VAR\n"
      "INITIAL_STEP A: q(N, done); ob(L, T#20ms, done, fault); oc(, done); END_STEP");
  EXPECT_EQ(run.traces({"main.q", "main.ob", "main.oc", "main.done"}, "0000"),
            (Traces{"1111", "1100", "1111", "0000"}));
}

// SFC-A-3
TEST(SfcAction, WhenABoolHasSAndROnly_ThenOthersMayChangeItToo) {
  ChartRun run(
      "INITIAL_STEP A: END_STEP STEP B: q(S); END_STEP STEP C: END_STEP STEP D: other(N); END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO C := go; END_TRANSITION\n"
      "TRANSITION FROM C TO D := go; END_TRANSITION ACTION other: q := FALSE; END_ACTION");
  EXPECT_EQ(run.trace("main.q", "0110100"), "0111000");
}

// SFC-A-4
TEST(SfcAction, WhenATargetIsAnAliasOrAnOutput_ThenItIsDriven) {
  ChartRun run(
      "VAR lamp : Flag; d : Driver; END_VAR d(); q := d.out; mark := 0;",
      "TYPE Flag : BOOL; END_TYPE\nFUNCTION_BLOCK Driver VAR_OUTPUT out : BOOL; alias : Flag; END_VAR\n"
      "INITIAL_STEP A: out(N); alias(L, T#20ms); END_STEP END_FUNCTION_BLOCK\n");
  EXPECT_EQ(run.traces({"main.q", "main.d.alias"}, "000"), (Traces{"111", "110"}));
}

// SFC-A-5
TEST(SfcAction, WhenDifferentQualifiersShareAnAction_ThenAnyOfThemMakesItActive) {
  ChartRun run(
      "INITIAL_STEP A: q(L, T#20ms); END_STEP STEP B: q(D, T#20ms); END_STEP STEP C: q(P0); END_STEP STEP D: "
      "END_STEP\nTRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO C := go; END_TRANSITION\n"
      "TRANSITION FROM C TO D := go; END_TRANSITION");
  EXPECT_EQ(run.trace("main.q", "0001000101000"), "1100011001000");
}

// SFC-A-6
TEST(SfcAction, WhenResetComesInTheFinalScanChart_ThenTheBodyRunsOnceMore) {
  ChartRun run(
      "VAR n : INT; END_VAR\n{sfc_final_scan}\n"
      "INITIAL_STEP A: work(S); END_STEP STEP B: work(R); END_STEP STEP C: END_STEP\n"
      "TRANSITION FROM A TO B := go; END_TRANSITION TRANSITION FROM B TO C := go; END_TRANSITION\n"
      "ACTION work: mark := 1; IF work.Q THEN mark := 2; END_IF; END_ACTION");
  EXPECT_EQ(run.trace("main.mark", "0010100"), "2210000");
}

}  // namespace
}  // namespace stepwright::lowering
