#include "runtime/record/variable_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/record/two_programs.h"

namespace stepwright::record {
namespace {

using ::std::string;

bool names(const std::vector<string>& list, const string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

TEST(VariableTransfer, WhenVariablesMove_ThenTheirValuesGoWithTheirNames) {
  TwoPrograms change(program("VAR a : INT; b : DINT; c : REAL; END_VAR"),
                     program("VAR c : REAL; fresh : INT := 5; B : DINT; a : INT; END_VAR"));
  change.before.set("MAIN.a", 11);
  change.before.set("MAIN.b", -12);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.a"), 11);
  EXPECT_EQ(change.after.get("MAIN.b"), -12);
  EXPECT_EQ(change.after.get("MAIN.fresh"), 5);
  EXPECT_EQ(change.report().carried, 3u);
  EXPECT_TRUE(names(change.report().initialised, "MAIN.fresh"));
}

TEST(VariableTransfer, WhenATypeIsAnother_ThenTheInitialValueStands) {
  TwoPrograms change(program("VAR a : INT := 1; gone : INT; END_VAR"), program("VAR a : DINT := 9; END_VAR"));
  change.before.set("MAIN.a", 11);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.a"), 9);
  EXPECT_TRUE(names(change.report().retyped, "MAIN.a"));
  EXPECT_TRUE(names(change.report().dropped, "MAIN.gone"));
}

TEST(VariableTransfer, WhenAConstantChanged_ThenTheNewProgramHasItsOwn) {
  const string body = "n := c;";
  TwoPrograms change(
      "VAR_GLOBAL CONSTANT g : INT := 1; END_VAR\n" +
          program("VAR CONSTANT c : INT := 1; l : ARRAY[0..1] OF INT := [1, 1]; END_VAR VAR n : INT; END_VAR",
                  body),
      "VAR_GLOBAL CONSTANT g : INT := 2; END_VAR\n" +
          program("VAR CONSTANT c : INT := 2; l : ARRAY[0..1] OF INT := [2, 2]; END_VAR VAR n : INT; END_VAR",
                  body));
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.c"), 2);
  EXPECT_EQ(change.after.get("MAIN.l[1]"), 2);
  EXPECT_EQ(change.after.get("g"), 2);
  EXPECT_FALSE(names(change.report().initialised, "MAIN.c"));
}

TEST(VariableTransfer, WhenArraysHaveOtherBounds_ThenCommonElementsKeepTheirIndex) {
  TwoPrograms change(program("VAR a : ARRAY[0..4] OF INT; m : ARRAY[0..1, 0..2] OF INT; END_VAR"),
                     program("VAR a : ARRAY[3..7] OF INT := [5(99)]; m : ARRAY[1..2, 1..5] OF INT; END_VAR"));
  change.before.set("MAIN.a[3]", 33);
  change.before.set("MAIN.a[4]", 44);
  change.before.set("MAIN.m[1][2]", 12);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.a[3]"), 33);
  EXPECT_EQ(change.after.get("MAIN.a[4]"), 44);
  EXPECT_EQ(change.after.get("MAIN.a[5]"), 99);
  EXPECT_EQ(change.after.get("MAIN.m[1][2]"), 12);
  EXPECT_TRUE(names(change.report().shortened, "MAIN.a"));
}

TEST(VariableTransfer, WhenAStringIsShorter_ThenItKeepsWhatFits) {
  TwoPrograms change(
      program(
          "VAR s : STRING[10] := 'abcdefgh'; w : WSTRING[4] := \"ab$D83D$DE00\"; l : STRING[3] := 'xyz';\n"
          "a : ARRAY[0..1] OF STRING[8] := ['first', 'second']; END_VAR"),
      program("VAR s : STRING[4]; w : WSTRING[3]; l : STRING[20]; a : ARRAY[0..1] OF STRING[3]; END_VAR"));
  change.carry();
  EXPECT_EQ(change.after.text("MAIN.s"), "abcd");
  EXPECT_EQ(change.after.text("MAIN.w"), "ab");  // not half of a pair
  EXPECT_EQ(change.after.text("MAIN.l"), "xyz");
  EXPECT_EQ(change.after.text("MAIN.a[1]"), "sec");
  EXPECT_TRUE(names(change.report().shortened, "MAIN.s"));
  EXPECT_FALSE(names(change.report().shortened, "MAIN.l"));
}

TEST(VariableTransfer, WhenStructuresGain_ThenMembersKeepTheirNames) {
  TwoPrograms change("TYPE P : STRUCT x : REAL; y : REAL; END_STRUCT; END_TYPE\n" +
                         program("VAR a : ARRAY[0..1] OF P; END_VAR"),
                     "TYPE P : STRUCT w : INT := 3; y : REAL; x : REAL; END_STRUCT; END_TYPE\n" +
                         program("VAR a : ARRAY[0..1] OF P; END_VAR"));
  change.before.set("MAIN.a[1].y", 0x40000000);  // 2.0
  change.carry();
  EXPECT_EQ(change.after.text("MAIN.a[1].y"), "2.0");
  EXPECT_EQ(change.after.get("MAIN.a[1].w"), 3);
}

TEST(VariableTransfer, WhenMembersHavePlaces_ThenBitsAndSharedMemoryGoWithTheirNames) {
  TwoPrograms change(
      "TYPE P : STRUCT a AT %X0.0 : BOOL; b AT %X0.7 : BOOL; n AT %B1 : INT; END_STRUCT;\n"
      "O : STRUCT OVERLAP w AT %W0 : WORD; l AT %B0 : BYTE; t AT %X1.6 : BOOL; END_STRUCT; END_TYPE\n" +
          program("VAR p : P; o : O; END_VAR"),
      "TYPE P : STRUCT n AT %B6 : INT; b AT %X3.1 : BOOL; a AT %X3.2 : BOOL := TRUE; END_STRUCT;\n"
      "O : STRUCT OVERLAP l AT %B0 : BYTE; t AT %X1.6 : BOOL; w AT %W0 : WORD; END_STRUCT; END_TYPE\n" +
          program("VAR pad : BYTE; o : O; p : P; END_VAR"));
  change.before.set("MAIN.p.b", 1);
  change.before.set("MAIN.p.n", -5);
  change.before.set("MAIN.o.w", 0x4321);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.p.a"), 0);
  EXPECT_EQ(change.after.get("MAIN.p.b"), 1);
  EXPECT_EQ(change.after.get("MAIN.p.n"), -5);
  EXPECT_EQ(change.after.get("MAIN.o.w"), 0x4321);
  EXPECT_EQ(change.after.get("MAIN.o.l"), 0x21);
  EXPECT_EQ(change.after.get("MAIN.o.t"), 1);
}

TEST(VariableTransfer, WhenAnEnumerationGainsANameOrASubrangeGrows_ThenTheValueStays) {
  TwoPrograms change("TYPE M : (IDLE, RUN); L : INT(0..10); K : INT(0..10); END_TYPE\n" +
                         program("VAR m : M; l : L; k : K; END_VAR"),
                     "TYPE M : (IDLE, RUN, HALT); L : INT(0..20); K : INT(2..9) := 2; END_TYPE\n" +
                         program("VAR m : M; l : L; k : K; END_VAR"));
  change.before.set("MAIN.m", 1);
  change.before.set("MAIN.l", 7);
  change.before.set("MAIN.k", 10);
  change.carry();
  EXPECT_EQ(change.after.text("MAIN.m"), "RUN");
  EXPECT_EQ(change.after.get("MAIN.l"), 7);
  EXPECT_EQ(change.after.get("MAIN.k"), 2);
  EXPECT_TRUE(names(change.report().retyped, "MAIN.k"));
}

// A running timer, a counter, the memory of an edge: what the compiler keeps for them is carried as well.
TEST(VariableTransfer, WhenTimersAndCountersRun_ThenTheyGoOn) {
  const string block =
      "FUNCTION_BLOCK Rises VAR_INPUT go : BOOL R_EDGE; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
      "IF go THEN n := n + 1; END_IF; END_FUNCTION_BLOCK\n";
  const string variables = "VAR t : TON; c : CTU; e : R_TRIG; r : Rises; on : BOOL := TRUE; END_VAR\n";
  const string body = "t(IN := on, PT := T#50ms); c(CU := on); e(CLK := on); r(go := on);";
  TwoPrograms change(block + program(variables, body),
                     block + program("VAR fresh : LINT; END_VAR\n" + variables, body));
  for (int scan = 0; scan < 4; ++scan) change.before.scan();
  EXPECT_EQ(change.before.text("MAIN.t.ET"), "T#30ms");
  // A second cycle whose time goes on where the first one stood.
  change.after.start_at(40'000'000);
  change.carry();
  change.after.scan();
  EXPECT_EQ(change.after.text("MAIN.t.ET"), "T#40ms");
  EXPECT_EQ(change.after.get("MAIN.t.Q"), 0);
  EXPECT_EQ(change.after.get("MAIN.c.CV"), 1);
  EXPECT_EQ(change.after.get("MAIN.e.Q"), 0);
  EXPECT_EQ(change.after.get("MAIN.r.n"), 1);
  change.after.scan();
  EXPECT_EQ(change.after.get("MAIN.t.Q"), 1);
}

// A chart of these steps, each left after 30 ms.
string chart(const std::vector<string>& steps, const string& more = "") {
  string text = "PROGRAM MAIN VAR " + more + " done : INT; END_VAR\n";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    text += (i == 0 ? "INITIAL_STEP " : "STEP ") + steps[i] + ": END_STEP\n";
    const string& next = steps[(i + 1) % steps.size()];
    text +=
        "TRANSITION FROM " + steps[i] + " TO " + next + " := " + steps[i] + ".T >= T#30ms; END_TRANSITION\n";
  }
  return text + "END_PROGRAM\n";
}

TEST(VariableTransfer, WhenAStepIsActive_ThenItStaysSoAndItsTimeGoesOn) {
  TwoPrograms change(chart({"A", "B", "C"}), chart({"NEW", "C", "B", "A"}, "fresh : LINT;"));
  int scans = 0;
  while (change.before.get("MAIN.B_X") == 0) {
    change.before.scan();
    ASSERT_LT(++scans, 20);
  }
  change.before.scan();
  change.after.start_at(std::int64_t{scans + 1} * 10'000'000);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.B_X"), 1);
  EXPECT_EQ(change.after.get("MAIN.NEW_X"), 0);  // initial, but the chart has its token already
  EXPECT_EQ(change.after.text("MAIN.B_T"), change.before.text("MAIN.B_T"));
  EXPECT_TRUE(change.transfer.lost_active_steps(change.before.image().bytes()).empty());
  ASSERT_EQ(change.report().new_steps.size(), 1u);
  EXPECT_EQ(change.report().new_steps[0].path, "MAIN.NEW_X");
  EXPECT_TRUE(change.report().new_steps[0].initial);
  change.before.scan();
  change.after.scan();
  EXPECT_EQ(change.after.get("MAIN.B_X"), change.before.get("MAIN.B_X"));
  EXPECT_EQ(change.after.text("MAIN.B_T"), change.before.text("MAIN.B_T"));
}

TEST(VariableTransfer, WhenAnActiveStepIsGone_ThenTheReportNamesIt) {
  TwoPrograms change(chart({"A", "B", "C"}), chart({"A", "C"}));
  EXPECT_TRUE(change.transfer.lost_active_steps(change.before.image().bytes()).empty());
  change.before.set("MAIN.B_X", 1);
  const auto lost = change.transfer.lost_active_steps(change.before.image().bytes());
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].path, "MAIN.B_X");
  // With its only active step gone the chart begins anew.
  change.before.set("MAIN.A_X", 0);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.A_X"), 1);
  EXPECT_EQ(change.after.get("MAIN.C_X"), 0);
  change.before.set("MAIN.B_X", 0);
  change.before.set("MAIN.C_X", 1);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.A_X"), 0);
  EXPECT_EQ(change.after.get("MAIN.C_X"), 1);
}

TEST(VariableTransfer, WhenVariablesAreLocated_ThenBitsAndUnnamedMarkersAreCarried) {
  TwoPrograms change(
      program("VAR o AT %QX0.3 : BOOL; m AT %MX1.2 : BOOL; b : BOOL; i AT %IX0.0 : BOOL; END_VAR",
              "%MW4 := 7;"),
      program("VAR o AT %QX1.5 : BOOL; m : BOOL; b AT %MX2.0 : BOOL; i AT %IX0.0 : BOOL; END_VAR",
              "%MW4 := %MW4;"));
  change.before.scan();
  change.before.set("MAIN.o", 1);
  change.before.set("MAIN.m", 1);
  change.before.set("MAIN.b", 1);
  change.before.set("MAIN.i", 1);
  change.carry();
  EXPECT_EQ(change.after.get("MAIN.o"), 1);
  EXPECT_EQ(change.after.get("MAIN.m"), 1);
  EXPECT_EQ(change.after.get("MAIN.b"), 1);
  EXPECT_EQ(change.after.get("MAIN.i"), 0);
  EXPECT_EQ(std::to_integer<int>(change.after.image().markers()[8]), 7);
}

TEST(VariableTransfer, WhenAddressesChange_ThenReferencesAreNotCarried) {
  const string body = "IF r = NULL THEN r := REF(n); END_IF;";
  TwoPrograms same(program("VAR n : INT; r : REF_TO INT; END_VAR", body),
                   program("VAR n : INT; r : REF_TO INT; END_VAR", body));
  EXPECT_TRUE(same.report().references.empty());
  TwoPrograms moved(program("VAR n : INT; r : REF_TO INT; END_VAR", body),
                    program("VAR fresh : INT; n : INT; r : REF_TO INT; END_VAR", body));
  moved.before.scan();
  moved.carry();
  EXPECT_TRUE(names(moved.report().references, "MAIN.r"));
  EXPECT_FALSE(moved.after.scan().trap);
}

// 10,000 variables that nothing lets join: between each two of them the new program has one more.
TEST(VariableTransfer, WhenTenThousandVariablesAreCarried_ThenItTakesMicrosecondsAndNoHeap) {
  string old_variables = "VAR\n";
  string new_variables = "VAR\n";
  for (int i = 0; i < 10'000; ++i) {
    const string line = "v" + std::to_string(i) +
                        (i % 4 == 0   ? " : BOOL;\n"
                         : i % 4 == 1 ? " : INT;\n"
                         : i % 4 == 2 ? " : REAL;\n"
                                      : " : LINT;\n");
    old_variables += line;
    new_variables += line + "w" + std::to_string(i) + " : BOOL;\n";
  }
  TwoPrograms apart(program(old_variables + "END_VAR"), program(new_variables + "END_VAR"));
  TwoPrograms same(program(old_variables + "END_VAR"), program(old_variables + "END_VAR"));
  ASSERT_EQ(apart.report().carried, 10'000u);
  const auto best_us = [](TwoPrograms& change) {
    double best = 1e9;
    for (int i = 0; i < 50; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      change.carry();
      best = std::min(
          best, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    }
    return best;
  };
  const support::GuardCounts before = support::guard_counts();
  apart.carry();
  EXPECT_EQ(support::guard_counts(), before);
  const double apart_us = best_us(apart);
  const double same_us = best_us(same);
  std::printf("10,000 variables: %.1f us each on its own, %.1f us where all join\n", apart_us, same_us);
  EXPECT_LT(apart_us, 1'000.0);  // generous: the machine may be busy
}

}  // namespace
}  // namespace stepwright::record
