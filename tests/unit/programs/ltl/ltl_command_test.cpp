// `stepwright ltl` as a user runs it, beside the commands that write what it reads and read what it writes.

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/command_run.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class LtlCommand : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright", arguments); }

  // A press that works for two scans after every three, and a level that rises.
  std::string recorded() {
    write("press.st",
          "PROGRAM main\nVAR press, wash : BOOL; level : INT; n : INT; END_VAR\n"
          "n := n + 1; level := 4 * n; press := n MOD 5 > 2; wash := n = 9;\nEND_PROGRAM\n");
    EXPECT_EQ(run("compile " + path("press.st") + " -o " + path("press.swb")), 0) << errors;
    EXPECT_EQ(run("exec " + path("press.swb") + " --scans 12 --trace main.press,main.wash,main.level --csv " +
                  path("press.csv")),
              0)
        << errors;
    return path("press.csv");
  }
};

TEST_F(LtlCommand, Check_WhenATraceWasRecorded_ThenItIsJudgedWithItsScan) {
  const std::string trace = recorded();
  const std::string names = " --let press=main.press --let wash=main.wash --let \"full=main.level >= 20\"";
  EXPECT_EQ(run("ltl check \"visit press then full\" " + trace + names + " --let x=main.wash"), 1);
  EXPECT_THAT(errors, HasSubstr("L0045"));
  const std::string two = " --let press=main.press --let \"full=main.level >= 20\"";
  EXPECT_EQ(run("ltl check \"visit press then full\" " + trace + two + " --json " + path("verdict.json")), 0)
      << errors;
  EXPECT_THAT(output, StartsWith("TRUE at scan 5, 0.04 s (" + trace + ":6): full"));
  const auto json = nlohmann::json::parse(text("verdict.json"));
  EXPECT_EQ(json["verdict"], "TRUE");
  EXPECT_EQ(json["scan"], "5");
  EXPECT_EQ(json["rows"], 12);
  EXPECT_EQ(run("ltl check \"visit main.press, never main.wash\" " + trace), 5);
  EXPECT_THAT(output, StartsWith("FALSE at scan 9"));
  EXPECT_THAT(output, HasSubstr("1:19: G !main.wash is FALSE at scan 9"));
  EXPECT_EQ(run("ltl check \"globally: main.press responds to main.wash\" " + trace), 1);
  EXPECT_THAT(errors, HasSubstr("L0014"));
}

TEST_F(LtlCommand, Check_WhenTheTraceDecidesNothing_ThenUndecidedAndWhatIsOpen) {
  const std::string trace = recorded();
  const std::string formula =
      "ltl check \"never (main.wash & !main.press), visit (main.wash & X main.wash)\" ";
  EXPECT_EQ(run(formula + trace), 0) << errors;
  EXPECT_THAT(output, StartsWith("UNDECIDED after 12 rows"));
  EXPECT_THAT(output, HasSubstr("was not violated"));
  EXPECT_THAT(output, HasSubstr("is still to be satisfied"));
  EXPECT_THAT(errors, HasSubstr("note: X is the next change of what holds"));
  EXPECT_EQ(run(formula + trace + " --decided"), 5);
}

// Its automaton would have more than a million states.
TEST_F(LtlCommand, Check_WhenTheAutomatonIsTooLarge_ThenItIsToldStepByStepAndSaysSo) {
  std::string table = "p1,p2,p3,p4,p5,p6,p7,p8\n";
  for (const char place : std::string("1230142"))
    for (char k = '1'; k <= '8'; ++k) table += std::string(k == place ? "1" : "0") + (k == '8' ? "\n" : ",");
  write("places.csv", table);
  write("visits.ltl", ltl::test::five_visits(8, true));
  EXPECT_EQ(
      run("ltl check " + path("visits.ltl") + " " + path("places.csv") + " --json " + path("verdict.json")),
      0)
      << errors;
  EXPECT_THAT(output, StartsWith("TRUE at row 7 "));
  EXPECT_THAT(errors, HasSubstr("too large for an automaton"));
  EXPECT_EQ(nlohmann::json::parse(text("verdict.json"))["stepwise"], true);
  EXPECT_EQ(run("ltl monitor " + path("visits.ltl")), 4);
}

TEST_F(LtlCommand, Check_WhenTheInputIsWrong_ThenItsPlaceIsNamed) {
  const std::string trace = recorded();
  EXPECT_EQ(run("ltl check \"visit (press\" " + trace), 1);
  EXPECT_THAT(errors, HasSubstr("1:13: L0002"));
  EXPECT_EQ(run("ltl check \"visit main.pres\" " + trace), 1);
  EXPECT_THAT(errors, HasSubstr("did you mean 'main.press'?"));
  EXPECT_EQ(run("ltl check \"visit main.level\" " + trace), 1);
  EXPECT_THAT(errors, HasSubstr(":2:"));
  EXPECT_THAT(errors, HasSubstr("L0044"));
  EXPECT_EQ(run("ltl check \"visit x\" " + path("nothing.csv")), 1);
  EXPECT_EQ(run("ltl check"), 2);
  EXPECT_EQ(run("ltl"), 2);
}

TEST_F(LtlCommand, Help_WhenAnOptionIsOneOfSomeWords_ThenItNamesThem) {
  EXPECT_EQ(run("ltl automaton --help"), 0);
  EXPECT_THAT(output, HasSubstr("{bad,good}"));
  EXPECT_EQ(run("ltl monitor --help"), 0);
  EXPECT_THAT(output, HasSubstr("{branches,table}"));
  EXPECT_EQ(output.find('\0'), std::string::npos);
  EXPECT_EQ(run("ltl automaton \"F a\" --part good"), 0) << errors;
  EXPECT_EQ(run("ltl monitor a --form leaves"), 2);
  EXPECT_THAT(errors, HasSubstr("leaves not in {branches,table}"));
}

TEST_F(LtlCommand, File_WhenItHasNoEnd_ThenRefusedAtOnce) {
  for (const char* name : {"zero.ltl", "zero.hoa", "zero.json", "zero.csv"})
    std::filesystem::create_symlink("/dev/zero", path(name));
  for (const std::string& command :
       {"automaton " + path("zero.ltl"), "automaton " + path("zero.hoa"), "monitor " + path("zero.ltl"),
        "check a " + path("zero.csv"), path("zero.json")}) {
    EXPECT_EQ(run("ltl " + command), 1) << command;
    EXPECT_THAT(errors, HasSubstr("E0001")) << command;
  }
}

TEST_F(LtlCommand, Automaton_WhenWritten_ThenItIsReadAgainInItsPlace) {
  const std::string trace = recorded();
  write("rule.ltl", "# no wash before the press\nnever main.wash before main.press\n");
  EXPECT_EQ(run("ltl automaton " + path("rule.ltl") + " -o " + path("rule.hoa")), 0) << errors;
  EXPECT_THAT(text("rule.hoa"), StartsWith("HOA: v1"));
  EXPECT_EQ(run("ltl check " + path("rule.hoa") + " " + trace), 0) << errors;
  EXPECT_THAT(output, StartsWith("TRUE at scan 3"));
  EXPECT_EQ(run("ltl automaton \"F a & F b\" --to svg"), 0) << errors;
  EXPECT_THAT(output, StartsWith("<svg"));
  EXPECT_EQ(run("ltl automaton \"G a & F b\""), 0) << errors;
  EXPECT_THAT(errors, HasSubstr("tells bad prefixes only"));
  EXPECT_EQ(run("ltl automaton \"F a & F b\" --to st"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("FUNCTION_BLOCK LTL_MONITOR"));
}

TEST_F(LtlCommand, Automaton_WhenItIsTooLarge_ThenTheBudgetEnded) {
  std::string formula = "F p0";
  for (int k = 1; k < 20; ++k) formula += " & F p" + std::to_string(k);
  EXPECT_EQ(run("ltl automaton \"" + formula + "\""), 4);
  EXPECT_THAT(errors, HasSubstr("L0012"));
}

TEST_F(LtlCommand, Monitor_WhenWritten_ThenItCompilesAndTellsWhatTheCheckTells) {
  recorded();
  EXPECT_EQ(run("ltl monitor \"visit press then (visit \\\"if\\\"), never State\" --name Watch -o " +
                path("watch.st")),
            0)
      << errors;
  EXPECT_THAT(text("watch.st"), HasSubstr("if_in : BOOL;  (* if *)"));
  EXPECT_THAT(text("watch.st"), HasSubstr("State_2 : BOOL;  (* State *)"));
  write("main.st",
        "PROGRAM main\nVAR w : Watch; n : INT; END_VAR\nn := n + 1;\n"
        "w(press := n = 2, if_in := n = 4, State_2 := n = 6);\nEND_PROGRAM\n");
  ASSERT_EQ(run("compile " + path("watch.st") + " " + path("main.st") + " -o " + path("watch.swb")), 0)
      << errors;
  ASSERT_EQ(
      run("exec " + path("watch.swb") + " --scans 7 --trace main.w.Verdict --json " + path("watch.json")), 0)
      << errors;
  const auto json = nlohmann::json::parse(text("watch.json"));
  EXPECT_EQ(json["trace"]["main.w.Verdict"], nlohmann::json({0, 0, 0, 0, 0, 2, 2}));
  EXPECT_EQ(run("ltl monitor a --name 1x"), 1);
  EXPECT_THAT(errors, HasSubstr("L0033"));
}

}  // namespace
}  // namespace stepwright::ltl_test
