// Charts through an online change: active steps, their times, stored actions.

#include <gtest/gtest.h>

#include "tests/unit/runtime/host/change_pair.h"

namespace stepwright::host {
namespace {

std::string active_steps(ChangePair& pair) {
  std::string text;
  const auto info = reader::ProgramInfo::read(pair.running().loaded().bytes());
  for (const reader::ChartInfo& chart : info->charts()) {
    for (const reader::StepInfo& step : chart.steps) {
      if (reader::read_number(step.active, pair.running().image().bytes()) != 0)
        text += chart.name + "." + step.name + " ";
    }
  }
  return text;
}

// Fills two tanks at once and drains them; `more` are further declarations, `extra` more of the chart.
std::string filling(const std::string& more = "", const std::string& extra = "",
                    const std::string& drain = "Drain") {
  return "PROGRAM main\n" + more +
         "VAR left AT %QX0.0 : BOOL; right AT %QX0.1 : BOOL; open AT %QX0.2 : BOOL; horn AT %QX0.3 : BOOL;\n"
         "  rounds, runs : INT; END_VAR\n"
         "INITIAL_STEP Idle: END_STEP\n"
         "STEP FillLeft: left(N); horn(S); count(P); END_STEP\n"
         "STEP LeftFull: END_STEP\n"
         "STEP FillRight: right(D, T#50ms); END_STEP\n"
         "STEP RightFull: watch(SL, T#200ms); END_STEP\n"
         "STEP " +
         drain +
         ": open(N); horn(R); tally(P); END_STEP\n"
         "TRANSITION FROM Idle TO (FillLeft, FillRight) := Idle.T >= T#20ms; END_TRANSITION\n"
         "TRANSITION FROM FillLeft TO LeftFull := FillLeft.T >= T#100ms; END_TRANSITION\n"
         "TRANSITION FROM FillRight TO RightFull := FillRight.T >= T#150ms; END_TRANSITION\n"
         "TRANSITION FROM (LeftFull, RightFull) TO " +
         drain +
         " := RightFull.T >= T#30ms; END_TRANSITION\n"
         "TRANSITION FROM " +
         drain + " TO Idle := " + drain + ".T >= T#40ms; END_TRANSITION\n" + extra +
         "ACTION count: runs := runs + 1; END_ACTION\n"
         "ACTION tally: rounds := rounds + 1; END_ACTION\n"
         "ACTION watch: runs := runs + 1000; END_ACTION\n"
         "END_PROGRAM\n";
}

const std::vector<std::string> kWatched = {"main.left", "main.right",  "main.open",
                                           "main.horn", "main.rounds", "main.runs"};

TEST(ChangeChart, WhenChangedInAnyScan_ThenTheChartGoesOnAsIfNothingHadHappened) {
  // Everything moves: another variable in front, another step at the end.
  const std::string changed_text = filling("VAR pad : ARRAY[0..4] OF LINT; END_VAR\n",
                                           "STEP Spare: END_STEP\n"
                                           "TRANSITION FROM Idle TO Spare := FALSE; END_TRANSITION\n"
                                           "TRANSITION FROM Spare TO Idle := TRUE; END_TRANSITION\n");
  for (int before = 1; before < 60; ++before) {
    ChangePair changed(filling(), changed_text);
    ChangePair reference(filling(), filling());
    changed.scan(before);
    ASSERT_TRUE(changed.change()) << result::to_string(changed.refusal);
    reference.scan(before);
    for (int after = 1; after < 50; ++after) {
      changed.scan(1);
      reference.scan(1);
      ASSERT_EQ(active_steps(changed), active_steps(reference)) << before << " + " << after;
      for (const std::string& path : kWatched)
        ASSERT_EQ(changed.text(path), reference.text(path)) << path << " " << before << " + " << after;
    }
  }
}

TEST(ChangeChart, WhenAnActiveStepHasNoCounterpart_ThenTheChangeIsRefusedAndNothingHappens) {
  ChangePair pair(filling(), filling("", "", "Empty"));
  ASSERT_TRUE(pair.refusal.empty()) << result::to_string(pair.refusal);
  while (active_steps(pair) != "main.Drain ") pair.scan(1);
  const std::vector<std::byte> image(pair.before().image().bytes().begin(),
                                     pair.before().image().bytes().end());
  EXPECT_FALSE(pair.change());
  ASSERT_EQ(pair.refusal.size(), 1u);
  EXPECT_EQ(pair.refusal[0].code, "R0033");
  EXPECT_NE(pair.refusal[0].message.find("main.Drain"), std::string::npos);
  EXPECT_TRUE(std::equal(image.begin(), image.end(), pair.before().image().bytes().begin()));
  // Once the chart has left it, the same change is safe.
  while (active_steps(pair) == "main.Drain ") pair.scan(1);
  EXPECT_TRUE(pair.change());
  EXPECT_EQ(active_steps(pair), "main.Idle ");
}

TEST(ChangeChart, WhenTheChartsRestart_ThenTheyBeginAnewAndVariablesStay) {
  for (int before = 1; before < 60; ++before) {
    ChangePair pair(filling(), filling("VAR pad : LINT; END_VAR\n", "", "Empty"),
                    DownloadMode::ChangeRestartCharts);
    ChangePair fresh(filling(), filling());
    pair.scan(before);
    const std::string rounds = pair.text("main.rounds");
    const std::string runs = pair.text("main.runs");
    ASSERT_TRUE(pair.change()) << result::to_string(pair.refusal);
    EXPECT_EQ(pair.text("main.rounds"), rounds);
    EXPECT_EQ(pair.text("main.runs"), runs);
    // What the old chart drove or stored is off, before the first scan and in it.
    for (int after = 0; after < 30; ++after) {
      for (const char* const output : {"main.left", "main.right", "main.open", "main.horn"})
        ASSERT_EQ(pair.text(output), fresh.text(output)) << output << " " << before << " + " << after;
      pair.scan(1);
      fresh.scan(1);
    }
  }
}

TEST(ChangeChart, WhenOtherLogicHoldsAnOutput_ThenARestartOfTheChartsLeavesIt) {
  const std::string text =
      "PROGRAM seal VAR pump AT %QX1.0 : BOOL; n : INT; END_VAR\n"
      "n := n + 1; IF n = 1 THEN pump := TRUE; END_IF;\nEND_PROGRAM\n" +
      filling() +
      "CONFIGURATION c RESOURCE r ON plc TASK t(INTERVAL := T#10ms, PRIORITY := 0);\n"
      "PROGRAM main WITH t : main; PROGRAM s WITH t : seal; END_RESOURCE END_CONFIGURATION\n";
  ChangePair pair(text, text, DownloadMode::ChangeRestartCharts);
  pair.scan(10);
  EXPECT_EQ(pair.text("main.left"), "TRUE");
  ASSERT_TRUE(pair.change());
  EXPECT_EQ(pair.text("main.left"), "FALSE");
  pair.scan(1);
  EXPECT_EQ(pair.text("s.pump"), "TRUE");
}

TEST(ChangeChart, WhenAChartIsNew_ThenItBeginsAtItsInitialStep) {
  ChangePair pair(program_text("VAR n : INT; END_VAR", "n := n + 1;"), filling());
  pair.scan(4);
  ASSERT_TRUE(pair.change());
  pair.scan(1);
  EXPECT_EQ(active_steps(pair), "main.Idle ");
}

// Idle, then Hold until the condition.
std::string holding(const std::string& condition) {
  return "PROGRAM main VAR go : BOOL; END_VAR\nINITIAL_STEP Idle: END_STEP\nSTEP Hold: END_STEP\n"
         "STEP Over: END_STEP\n"
         "TRANSITION FROM Idle TO Hold := Idle.T >= T#200ms; END_TRANSITION\n"
         "TRANSITION FROM Hold TO Over := " +
         condition +
         "; END_TRANSITION\n"
         "TRANSITION FROM Over TO Idle := FALSE; END_TRANSITION\nEND_PROGRAM\n";
}

TEST(ChangeChart, WhenTheTimeOfAnActiveStepIsNew_ThenItCountsFromTheChange) {
  ChangePair pair(holding("go"), holding("Hold.T >= T#100ms"));
  pair.scan(40);
  ASSERT_EQ(active_steps(pair), "main.Hold ");
  ASSERT_TRUE(pair.change());
  pair.scan(9);
  EXPECT_EQ(active_steps(pair), "main.Hold ");
  pair.scan(3);
  EXPECT_EQ(active_steps(pair), "main.Over ");
}

TEST(ChangeChart, WhenTheTimeOfAnActiveStepStays_ThenItGoesOn) {
  ChangePair pair(holding("Hold.T >= T#300ms"), holding("Hold.T >= T#310ms"));
  pair.scan(40);
  ASSERT_EQ(active_steps(pair), "main.Hold ");
  ASSERT_TRUE(pair.change());
  pair.scan(10);
  EXPECT_EQ(active_steps(pair), "main.Hold ");
  pair.scan(4);
  EXPECT_EQ(active_steps(pair), "main.Over ");
}

// Left and Right at the same time, or one of the two.
std::string branches(bool simultaneous) {
  const std::string steps =
      "PROGRAM main VAR go : BOOL; END_VAR\nINITIAL_STEP Idle: END_STEP\nSTEP Left: END_STEP\n"
      "STEP Right: END_STEP\n";
  return steps +
         (simultaneous ? "TRANSITION FROM Idle TO (Left, Right) := Idle.T >= T#50ms; END_TRANSITION\n"
                         "TRANSITION FROM (Left, Right) TO Idle := go; END_TRANSITION\n"
                       : "TRANSITION FROM Idle TO Left := Idle.T >= T#50ms AND NOT go; END_TRANSITION\n"
                         "TRANSITION FROM Idle TO Right := Idle.T >= T#50ms AND go; END_TRANSITION\n"
                         "TRANSITION FROM Left TO Idle := go; END_TRANSITION\n"
                         "TRANSITION FROM Right TO Idle := go; END_TRANSITION\n") +
         "END_PROGRAM\n";
}

TEST(ChangeChart, WhenActiveStepsCannotBeActiveTogetherAnyMore_ThenTheChangeIsRefused) {
  ChangePair pair(branches(true), branches(false));
  pair.scan(10);
  ASSERT_EQ(active_steps(pair), "main.Left main.Right ");
  EXPECT_FALSE(pair.change());
  ASSERT_EQ(pair.refusal.size(), 1u);
  EXPECT_EQ(pair.refusal[0].code, "R0036");
  EXPECT_NE(pair.refusal[0].message.find("main"), std::string::npos);

  ChangePair idle(branches(true), branches(false));
  idle.scan(2);
  EXPECT_TRUE(idle.change()) << result::to_string(idle.refusal);

  ChangePair half(branches(false), branches(true));
  half.scan(10);
  ASSERT_EQ(active_steps(half), "main.Left ");
  EXPECT_FALSE(half.change());

  ChangePair restarted(branches(true), branches(false), DownloadMode::ChangeRestartCharts);
  restarted.scan(10);
  EXPECT_TRUE(restarted.change());
}

TEST(ChangeChart, WhenChartsAreInBlocks_ThenEachInstanceGoesOnByItself) {
  const auto text = [](const char* names) {
    return std::string(
               "FUNCTION_BLOCK Blink VAR_INPUT t : TIME; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n"
               "INITIAL_STEP Off: END_STEP STEP Lit: q(N); END_STEP\n"
               "TRANSITION FROM Off TO Lit := Off.T >= t; END_TRANSITION\n"
               "TRANSITION FROM Lit TO Off := Lit.T >= t; END_TRANSITION\nEND_FUNCTION_BLOCK\n") +
           program_text("VAR " + std::string(names) + " : Blink; END_VAR", "a(t := T#30ms); b(t := T#50ms);");
  };
  for (int before = 1; before < 30; ++before) {
    ChangePair changed(text("a, b"), text("x, b, a"));
    ChangePair reference(text("a, b"), text("a, b"));
    changed.scan(before);
    ASSERT_TRUE(changed.change()) << result::to_string(changed.refusal);
    reference.scan(before);
    for (int after = 1; after < 20; ++after) {
      changed.scan(1);
      reference.scan(1);
      for (const char* const path : {"main.a.q", "main.b.q"})
        ASSERT_EQ(changed.text(path), reference.text(path)) << path << " " << before << " + " << after;
    }
  }
}

}  // namespace
}  // namespace stepwright::host
