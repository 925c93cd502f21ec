#include "cell/trial/judge.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace stepwright::trial {
namespace {

const std::string kBinding = R"toml([tags]
P = { address = "%QX0.0" }
L = { address = "%IW1", type = "INT" }
M = { address = "%IW2", type = "INT" }
C = { address = "%IX0.0" }
[sensors.L]
tag = "L"
fluent = "(level t1)"
calibration = [[0, 0], [50, 27648]]
tolerance = 0.5
[sensors.M]
tag = "M"
fluent = "(level t2)"
calibration = [[0, 0], [50, 27648]]
tolerance = 0.5
[[facts]]
fact = "(full t1)"
tag = "C"
[[actions]]
action = "(fill ?t ?a)"
outputs = ["P"]
until = { fluent = "(level ?t)", pre_act = 0.2 }
timeout_s = 30
duration = { fixed_s = 1, per_unit_s = 1, of = "(level ?t)" }
)toml";

translate::Binding binding() {
  auto read = translate::read_binding(kBinding, "binding.toml");
  if (!read) throw std::runtime_error(result::to_string(read.error()));
  return *read;
}

// (fill t1 aN) from 0 to `amount`: all as it should be.
ActionRun run_of(double amount, double active_s) {
  ActionRun run;
  run.end = RunEnd::Done;
  run.active_s = active_s;
  run.planned.action = {"fill", {"t1", "a" + std::to_string(static_cast<int>(amount))}};
  run.planned.before.fluents = {{"(level t1)", 0.0}, {"(level t2)", 0.0}};
  run.planned.after.fluents = {{"(level t1)", amount}, {"(level t2)", 0.0}};
  run.before = {{"(level t1)", 0.0}, {"(level t2)", 0.0}, {"(full t1)", 0.0}};
  run.after = {{"(level t1)", amount}, {"(level t2)", 0.0}, {"(full t1)", 0.0}};
  run.expected = run.after;
  return run;
}

std::vector<std::string> codes(const Findings& problems) {
  std::vector<std::string> codes;
  for (const result::Diagnostic& each : problems) codes.push_back(each.code);
  return codes;
}

using Codes = std::vector<std::string>;

TEST(JudgeRuns, WhenAllIsAsClaimed_ThenNothingIsSaid) {
  const std::vector<ActionRun> runs = {run_of(10, 11), run_of(10, 11.2)};
  EXPECT_EQ(codes(judge_runs(binding(), runs)), Codes{});
}

TEST(JudgeRuns, WhenALevelEndsTooFar_ThenPreActGrowsByAsMuch) {
  ActionRun run = run_of(10, 11);
  run.after["(level t1)"] = 11.0;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0028"});
  EXPECT_EQ(problems.front().hint, "until = { fluent = \"(level ?t)\", pre_act = 1.2 }");
}

TEST(JudgeRuns, WhenAnotherLevelChanges_ThenTheDomainIsSilentOfIt) {
  ActionRun run = run_of(10, 11);
  run.after["(level t2)"] = -2.0;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0029"});
  EXPECT_EQ(problems.front().hint, "(decrease (level t2) 2) in the effect");
  EXPECT_EQ(problems.front().subject, "decrease (level ?)") << "of a tank that the action does not name";
}

TEST(JudgeRuns, WhenAFactComesOfWhichNobodySpoke_ThenItIsNamed) {
  ActionRun run = run_of(10, 11);
  run.after["(full t1)"] = 1.0;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0029"});
  EXPECT_EQ(problems.front().subject, "true (full ?t)") << "the same of every tank that is filled";
}

TEST(JudgeRuns, WhenAClaimedFactIsNotShown_ThenItIsNamedInSoManyRuns) {
  ActionRun wrong = run_of(10, 11);
  wrong.planned.after.facts.insert("(full t1)");
  wrong.expected["(full t1)"] = 1.0;
  ActionRun right = wrong;
  right.after["(full t1)"] = 1.0;
  const Findings problems = judge_runs(binding(), std::vector{wrong, right});
  ASSERT_EQ(codes(problems), Codes{"B0027"});
  EXPECT_NE(problems.front().message.find("in 1 of 2 runs"), std::string::npos);
}

TEST(JudgeRuns, WhenItTakesLongerThanItsTimeout_ThenOneWithRoomIsProposed) {
  const Findings problems = judge_runs(binding(), std::vector{run_of(10, 40)});
  ASSERT_EQ(codes(problems), Codes{"B0026"});
  EXPECT_EQ(problems.front().hint, "timeout_s = 60");
}

TEST(JudgeRuns, WhenNothingMovesInItsTime_ThenItHasNoEffect) {
  ActionRun run = run_of(10, 150);
  run.end = RunEnd::TimedOut;
  run.after = run.before;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{"B0024"});
}

TEST(JudgeRuns, WhenAnotherLevelRisesInItsPlace_ThenItsTagIsProposed) {
  ActionRun run = run_of(10, 150);
  run.end = RunEnd::TimedOut;
  run.after = run.before;
  run.after["(level t2)"] = 10.0;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0024"});
  EXPECT_NE(problems.front().hint.find("tag = \"M\" for 'L', if the tags of the two are swapped"),
            std::string::npos)
      << problems.front().hint;
  run.after["(level t2)"] = -10.0;
  EXPECT_EQ(judge_runs(binding(), std::vector{run}).front().hint.find("swapped"), std::string::npos);
}

TEST(JudgeRuns, WhenEachOfTwoSensorsBeginsWhereTheOtherOneShould_ThenTheirTagsAreSwapped) {
  ActionRun run = run_of(10, 3);
  run.end = RunEnd::NotBegun;
  run.expected = {{"(level t1)", 5.0}, {"(level t2)", 30.0}};
  run.after = {{"(level t1)", 30.1}, {"(level t2)", 4.9}};
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0020"});
  EXPECT_EQ(problems.front().hint.rfind("each shows what the other one should: tag = \"M\" for 'L'", 0), 0u)
      << problems.front().hint;
  run.after["(level t2)"] = 12.0;
  EXPECT_EQ(judge_runs(binding(), std::vector{run}).front().hint,
            "change :init, or the start values of the plant");
}

std::string hint_with_tags(const std::string& tags, const std::string& more, const Reading& expected,
                           const Reading& after) {
  const std::string begin = "[tags]\n";
  const auto read =
      translate::read_binding(begin + tags + kBinding.substr(begin.size()) + more, "binding.toml");
  if (!read) throw std::runtime_error(result::to_string(read.error()));
  ActionRun run = run_of(10, 3);
  run.end = RunEnd::NotBegun;
  run.expected = expected;
  run.after = after;
  return judge_runs(*read, std::vector{run}).front().hint;
}

// The one has 2 t at 27648 counts, the other one 40 percent.
TEST(JudgeRuns, WhenTwoSensorsOfOtherCalibrationsAreSwapped_ThenTheirCountsTellIt) {
  const std::string more = R"toml([sensors.mass]
tag = "MASS"
fluent = "(mass d)"
calibration = [[0, 0], [2, 27648]]
tolerance = 0.05
[sensors.moisture]
tag = "MOISTURE"
fluent = "(moisture d)"
calibration = [[0, 0], [40, 27648]]
tolerance = 1.5
[[actions]]
action = "(load ?b ?a)"
outputs = ["P"]
until = { fluent = "(mass ?b)" }
timeout_s = 30
)toml";
  const std::string tags =
      "MASS = { address = \"%IW3\", type = \"INT\" }\nMOISTURE = { address = \"%IW4\", "
      "type = \"INT\" }\n";
  const std::string hint = hint_with_tags(tags, more, {{"(mass d)", 0.1}, {"(moisture d)", 22.0}},
                                          {{"(mass d)", 1.1}, {"(moisture d)", 2.0}});
  EXPECT_EQ(
      hint.rfind("each shows what the other one should: tag = \"MOISTURE\" for 'mass' and tag = \"MASS\" "
                 "for 'moisture'",
                 0),
      0u)
      << hint;
}

TEST(JudgeRuns, WhenTwoFactsBeginAsTheOtherOneShould_ThenTheirTagsAreSwapped) {
  const std::string tags = "O = { address = \"%IX0.1\" }\nS = { address = \"%IX0.2\" }\n";
  const std::string more =
      "[[facts]]\nfact = \"(open d)\"\ntag = \"O\"\n[[facts]]\nfact = \"(shut d)\"\ntag = \"S\"\n";
  const std::string hint = hint_with_tags(tags, more, {{"(open d)", 0.0}, {"(shut d)", 1.0}},
                                          {{"(open d)", 1.0}, {"(shut d)", 0.0}});
  EXPECT_EQ(hint.rfind("each shows what the other one should: tag = \"S\" for '(open d)'", 0), 0u) << hint;
  const std::string both = hint_with_tags(tags, more, {{"(open d)", 1.0}, {"(shut d)", 1.0}},
                                          {{"(open d)", 0.0}, {"(shut d)", 0.0}});
  EXPECT_EQ(both, "change :init, or the start values of the plant");
}

TEST(JudgeRuns, WhenALevelWasElsewhereBefore_ThenTheActionHasNotChangedIt) {
  ActionRun run = run_of(10, 11);
  run.before["(level t2)"] = 3.0;
  run.after["(level t2)"] = 3.0;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{});
}

// What fills t1 by 10 takes 10 from t2, which begins 5 below the plan.
TEST(JudgeRuns, WhenALevelBeganElsewhere_ThenItsChangeIsCompared) {
  ActionRun run = run_of(10, 11);
  run.planned.after.fluents["(level t2)"] = -10.0;
  run.expected["(level t2)"] = -10.0;
  run.before["(level t2)"] = -5.0;
  run.after["(level t2)"] = -15.0;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{});
  run.after["(level t2)"] = -10.0;  // as an effect that assigns the level
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{});
  run.after["(level t2)"] = -18.0;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0028"});
  EXPECT_NE(problems.front().message.find("by -10 in the domain, and the plant by -13"), std::string::npos)
      << problems.front().message;
}

// It fills up to 10 from 4: what it takes from t2 is as much less.
TEST(JudgeRuns, WhenTheLevelThatEndsItBeganElsewhere_ThenTheOthersChangeInProportion) {
  ActionRun run = run_of(10, 7);
  run.planned.after.fluents["(level t2)"] = -10.0;
  run.expected["(level t2)"] = -10.0;
  run.before["(level t1)"] = 4.0;
  run.after["(level t2)"] = -6.0;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{});
  run.after["(level t1)"] = 14.0;  // as far as planned, and beyond where it ends
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{"B0028"});
  run.before["(level t1)"] = 14.0;  // it was there already, and ends at once
  run.after["(level t2)"] = 0.0;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{});
}

TEST(JudgeRuns, WhenAFactWasOtherwiseBefore_ThenTheActionHasNotMadeItSo) {
  ActionRun run = run_of(10, 11);
  run.before["(full t1)"] = 1.0;
  run.after["(full t1)"] = 1.0;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{});
}

TEST(JudgeRuns, WhenItBeganElsewhereAndIsTooSlow_ThenTheWayIsThatFromThere) {
  ActionRun run = run_of(10, 100);
  run.end = RunEnd::TimedOut;
  run.before["(level t1)"] = -10.0;
  run.after["(level t1)"] = 0.0;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0026"});
  EXPECT_NE(problems.front().message.find("by 10 of 20 in 100 s"), std::string::npos);
  EXPECT_EQ(problems.front().hint.rfind("timeout_s = 300 at 0.1 units a second", 0), 0u);
}

// It has gone the other way, too slowly to be stopped for that: no time would be enough.
TEST(JudgeRuns, WhenALevelHasFallenInAllItsTime_ThenNoTimeoutIsProposed) {
  ActionRun run = run_of(10, 150);
  run.end = RunEnd::TimedOut;
  run.after["(level t1)"] = -1.5;
  EXPECT_EQ(codes(judge_runs(binding(), std::vector{run})), Codes{"B0025"});
}

TEST(JudgeRuns, WhenALevelFallsInsteadOfRising_ThenTheSignIsWrong) {
  ActionRun run = run_of(10, 3);
  run.end = RunEnd::WrongWay;
  run.after["(level t1)"] = -2.5;
  const Findings problems = judge_runs(binding(), std::vector{run});
  ASSERT_EQ(codes(problems), Codes{"B0025"});
  EXPECT_NE(problems.front().message.find("the plant lowers it"), std::string::npos);
}

TEST(JudgeDuration, WhenItIsFarOff_ThenTheLineThroughTheMeasuredTimesIsProposed) {
  const translate::Binding bound = binding();
  const std::vector<ActionRun> runs = {run_of(10, 32), run_of(20, 62), run_of(20, 62)};
  const Findings problems = judge_duration(bound, bound.actions.front(), runs);
  ASSERT_EQ(codes(problems), Codes{"B0030"});
  EXPECT_EQ(problems.front().hint, "duration = { fixed_s = 2, per_unit_s = 3, of = \"(level ?t)\" }");
}

TEST(JudgeDuration, WhenItIsNear_ThenNothingIsSaid) {
  const translate::Binding bound = binding();
  EXPECT_EQ(codes(judge_duration(bound, bound.actions.front(), std::vector{run_of(10, 12), run_of(20, 24)})),
            Codes{});
}

// From one start it has 5 to move, from the other one 20.
TEST(JudgeDuration, WhenOneActionHasOtherAmountsFromOtherStarts_ThenEachIsComparedWithItsOwn) {
  const translate::Binding bound = binding();
  ActionRun less = run_of(20, 6);
  less.planned.before.fluents["(level t1)"] = 15.0;
  EXPECT_EQ(codes(judge_duration(bound, bound.actions.front(), std::vector{less, run_of(20, 21)})), Codes{});
}

// From -20 instead of 0: that it takes three times as long is not of its duration.
TEST(JudgeDuration, WhenItBeganElsewhere_ThenTheRunDoesNotCount) {
  const translate::Binding bound = binding();
  ActionRun run = run_of(10, 31);
  run.before["(level t1)"] = -20.0;
  EXPECT_EQ(codes(judge_duration(bound, bound.actions.front(), std::vector{run})), Codes{});
  EXPECT_EQ(codes(judge_runs(bound, std::vector{run})), Codes{}) << "nor of its timeout";
}

TEST(Spread, WhenARunDidNotEnd_ThenItDoesNotCount) {
  std::vector<ActionRun> runs = {run_of(10, 10), run_of(10, 14), run_of(10, 99)};
  runs.back().end = RunEnd::TimedOut;
  const Spread spread = spread_of(runs);
  EXPECT_EQ(spread.runs, 2u);
  EXPECT_DOUBLE_EQ(spread.mean_s, 12.0);
  EXPECT_DOUBLE_EQ(spread.spread_s, 2.0);
}

}  // namespace
}  // namespace stepwright::trial
