#include "runtime/host/change_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/runtime/host/change_pair.h"

namespace stepwright::host {
namespace {

// The values of `paths` after `before` scans, a change and `after` scans are those without a change. The two
// texts differ so that every address moves.
void expect_unnoticed(const std::string& declarations, const std::string& body, int before, int after,
                      const std::vector<std::string>& paths) {
  const std::string old_text = program_text("VAR pad : INT; END_VAR\n" + declarations, body);
  const std::string new_text =
      program_text("VAR more : LINT; other : STRING[7]; END_VAR\n" + declarations, body);
  ChangePair changed(old_text, new_text);
  ChangePair reference(old_text, old_text);
  ASSERT_TRUE(changed.refusal.empty()) << result::to_string(changed.refusal);
  changed.scan(before);
  ASSERT_TRUE(changed.change()) << result::to_string(changed.refusal);
  changed.scan(after);
  reference.scan(before + after);
  for (const std::string& path : paths) EXPECT_EQ(changed.text(path), reference.text(path)) << path;
  EXPECT_EQ(changed.last.scan, reference.last.scan);
  EXPECT_EQ(changed.last.time_ns, reference.last.time_ns);
}

TEST(ChangePlan, WhenTimersRun_ThenTheyGoOnAsIfNothingHadHappened) {
  for (const int scans : {1, 30, 49, 50, 51, 70}) {
    expect_unnoticed(
        "VAR on : TON; off : TOF; pulse : TP; n : DINT; END_VAR",
        "n := n + 1;\n"
        "on(IN := TRUE, PT := T#500ms);\n"
        "off(IN := n < 20, PT := T#300ms);\n"
        "pulse(IN := n > 10, PT := T#450ms);\n",
        scans, 20,
        {"main.on.Q", "main.on.ET", "main.off.Q", "main.off.ET", "main.pulse.Q", "main.pulse.ET", "main.n"});
  }
}

TEST(ChangePlan, WhenCountersAndEdgesHaveAMemory_ThenNoEdgeIsLostOrCountedTwice) {
  for (int scans = 1; scans < 12; ++scans) {
    expect_unnoticed("VAR up : CTU; down : CTD; rise : R_TRIG; fall : F_TRIG; n, seen, gone : DINT; END_VAR",
                     "n := n + 1;\n"
                     "up(CU := (n MOD 4) < 2, PV := 100);\n"
                     "down(CD := (n MOD 3) = 0, LD := n = 1, PV := 50);\n"
                     "rise(CLK := (n MOD 5) > 2); IF rise.Q THEN seen := seen + 1; END_IF;\n"
                     "fall(CLK := (n MOD 5) > 2); IF fall.Q THEN gone := gone + 1; END_IF;\n",
                     scans, 7, {"main.up.CV", "main.down.CV", "main.seen", "main.gone"});
  }
}

TEST(ChangePlan, WhenBlocksHaveEdgeInputs_ThenTheirHiddenMemoryGoesWithThem) {
  const std::string block =
      "FUNCTION_BLOCK Tally\n"
      "VAR_INPUT step : BOOL R_EDGE; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
      "IF step THEN n := n + 1; END_IF;\nEND_FUNCTION_BLOCK\n";
  const std::string body = "t(step := TRUE);\n";
  ChangePair pair(block + program_text("VAR t : Tally; END_VAR", body),
                  block + program_text("VAR x : LINT; t : Tally; END_VAR", body));
  pair.scan(3);
  ASSERT_TRUE(pair.change());
  pair.scan(3);
  EXPECT_EQ(pair.text("main.t.n"), "1");
}

TEST(ChangePlan, WhenArraysStructsAndStringsStay_ThenTheirValuesDo) {
  expect_unnoticed(
      "VAR a : ARRAY[1..3, 0..1] OF INT; s : STRING[20]; w : WSTRING[9]; r : LREAL; n : DINT; END_VAR",
      "n := n + 1; a[2, 1] := a[2, 1] + 3; a[3, 0] := -5;\n"
      "s := 'level'; w := \"höhe\"; r := r + 0.1;\n",
      5, 4, {"main.a[2][1]", "main.a[3][0]", "main.s", "main.w", "main.r", "main.n"});
}

TEST(ChangePlan, WhenVariablesAreAddedRemovedRenamedOrRetyped_ThenOnlyTheOthersKeepTheirValues) {
  const std::string block =
      "FUNCTION_BLOCK Count VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK\n"
      "TYPE Point : STRUCT x, y : INT; END_STRUCT; END_TYPE\n"
      "TYPE Wide : STRUCT y : INT; z : INT := 9; x : DINT; END_STRUCT; END_TYPE\n";
  ChangePair pair(
      block + program_text("VAR keep : INT; gone : INT; typed : INT; c, d : Count; p : Point; END_VAR",
                           "keep := 7; gone := 8; typed := 9; c(); d(); p.x := 1; p.y := 2;"),
      block + program_text("VAR fresh : INT := 44; typed : REAL := 1.5; e : Count; p : Wide; "
                           "KEEP : INT; d : Count; END_VAR",
                           ";"));
  pair.scan(3);
  ASSERT_TRUE(pair.change());
  EXPECT_EQ(pair.text("main.keep"), "7");
  EXPECT_EQ(pair.text("main.fresh"), "44");
  EXPECT_EQ(pair.text("main.typed"), "1.5");
  EXPECT_EQ(pair.text("main.d.n"), "3");
  EXPECT_EQ(pair.text("main.e.n"), "0");
  EXPECT_EQ(pair.text("main.p.y"), "2");
  EXPECT_EQ(pair.text("main.p.z"), "9");
  EXPECT_EQ(pair.text("main.p.x"), "0");  // INT became DINT
  const ChangeReport report = pair.plan().report();
  EXPECT_EQ(report.carried, 3u);      // keep, d.n, p.y
  EXPECT_EQ(report.initialised, 3u);  // fresh, e.n, p.z
  EXPECT_EQ(report.dropped, 2u);      // gone, c.n
  EXPECT_EQ(report.retyped, 2u);      // typed, p.x
  const std::string notes = result::to_string(pair.plan().notes());
  EXPECT_NE(notes.find("main.gone"), std::string::npos) << notes;
  EXPECT_FALSE(result::has_errors(pair.plan().notes()));
}

TEST(ChangePlan, WhenAnOutputMovesToAnotherTerminal_ThenTheChangeIsRefused) {
  ChangePair pair(
      program_text("VAR pump AT %QX0.0 : BOOL; valve AT %QX0.1 : BOOL; END_VAR", "pump := TRUE;"),
      program_text("VAR pump AT %QX0.3 : BOOL; valve AT %QX0.1 : BOOL; END_VAR", "pump := TRUE;"));
  ASSERT_EQ(pair.refusal.size(), 1u);
  EXPECT_EQ(pair.refusal[0].code, "R0034");
  EXPECT_NE(pair.refusal[0].message.find("main.pump"), std::string::npos);
}

TEST(ChangePlan, WhenNobodyDrivesAnOutputAnyMore_ThenItDoesNotStayOn) {
  const std::string outputs =
      "VAR pump AT %QX0.0 : BOOL; lamp AT %QX0.1 : BOOL; speed AT %QW2 : INT; END_VAR";
  ChangePair pair(program_text(outputs, "pump := TRUE; lamp := TRUE; speed := 1200;"),
                  program_text(outputs, "IF FALSE THEN lamp := FALSE; END_IF;"));
  pair.scan(2);
  ASSERT_TRUE(pair.change());
  pair.scan(1);
  EXPECT_EQ(pair.text("main.pump"), "FALSE");
  EXPECT_EQ(pair.text("main.speed"), "0");
  EXPECT_EQ(pair.text("main.lamp"), "TRUE");  // driven under a condition: it keeps its value
}

TEST(ChangePlan, WhenVariablesAreForced_ThenTheForcesGoWithThem) {
  ChangePair pair(
      program_text(
          "VAR a, b : INT; gone : DINT; c : BOOL; in AT %IX1.2 : BOOL; out AT %QX0.4 : BOOL; END_VAR",
          "a := 1; c := FALSE; out := FALSE;"),
      program_text("VAR x : LINT; c : BOOL; b, a : INT; in AT %IX1.2 : BOOL; out AT %QX0.4 : BOOL; END_VAR",
                   "a := 1; c := FALSE; out := FALSE; b := a;"));
  pair.force("main.a", 77);
  pair.force("main.c", 1);
  pair.force("main.gone", 5);
  pair.force("main.in", 1);
  pair.force("main.out", 1);
  pair.scan(2);
  ASSERT_TRUE(pair.change());
  EXPECT_EQ(pair.dropped_forces, 1u);
  pair.scan(2);
  EXPECT_EQ(pair.text("main.a"), "77");
  EXPECT_EQ(pair.text("main.c"), "TRUE");
  EXPECT_EQ(pair.text("main.in"), "TRUE");
  EXPECT_EQ(pair.text("main.out"), "TRUE");
  EXPECT_EQ(pair.text("main.x"), "0");
  EXPECT_EQ(pair.running().cycle().forces().forces().size(), 4u);
}

TEST(ChangePlan, WhenTasksStay_ThenTheyKeepTheirPhase) {
  const auto text = [](const std::string& fast, const std::string& more) {
    return "PROGRAM a VAR n : DINT; END_VAR n := n + 1; END_PROGRAM\n"
           "CONFIGURATION c RESOURCE r ON plc\n"
           "TASK slow(INTERVAL := T#70ms, PRIORITY := 2);\nTASK fast(INTERVAL := " +
           fast + ", PRIORITY := 1);\n" + more +
           "PROGRAM one WITH slow : a;\nPROGRAM two WITH fast : a;\nEND_RESOURCE END_CONFIGURATION\n";
  };
  ChangePair same(text("T#30ms", ""), text("T#30ms", "TASK spare(INTERVAL := T#500ms, PRIORITY := 0);\n"));
  ChangePair reference(text("T#30ms", ""), text("T#30ms", ""));
  same.scan(6);
  ASSERT_TRUE(same.change());
  // The spare task is due with the next scan, which lies 500 ms before its second one.
  same.scan(8);
  reference.scan(14);
  EXPECT_EQ(same.text("one.n"), reference.text("one.n"));
  EXPECT_EQ(same.text("two.n"), reference.text("two.n"));
  EXPECT_EQ(same.last.time_ns, reference.last.time_ns);

  ChangePair shorter(text("T#10s", ""), text("T#10ms", ""));
  shorter.scan(2);
  ASSERT_TRUE(shorter.change());
  const std::int64_t at_ns = shorter.running().cycle().next_time_ns();
  shorter.scan(3);
  EXPECT_LE(shorter.last.time_ns, at_ns + 30'000'000);
}

TEST(ChangePlan, WhenASingleTaskHasSeenItsTrigger_ThenItDoesNotRunAgainForIt) {
  const std::string text =
      "VAR_GLOBAL go : BOOL; END_VAR\n"
      "PROGRAM a VAR n : DINT; END_VAR n := n + 1; END_PROGRAM\n"
      "PROGRAM b VAR_EXTERNAL go : BOOL; END_VAR go := TRUE; END_PROGRAM\n"
      "CONFIGURATION c RESOURCE r ON plc\n"
      "TASK t(INTERVAL := T#10ms, PRIORITY := 0);\nTASK once(SINGLE := go, PRIORITY := 2);\n"
      "PROGRAM setter WITH t : b;\nPROGRAM p WITH once : a;\nEND_RESOURCE END_CONFIGURATION\n";
  ChangePair pair("VAR_GLOBAL pad : LINT; END_VAR\n" + text, text);
  pair.scan(5);
  ASSERT_TRUE(pair.change());
  pair.scan(5);
  EXPECT_EQ(pair.text("p.n"), "1");
}

}  // namespace
}  // namespace stepwright::host
