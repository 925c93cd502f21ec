#include "cell/monitors/cell_monitors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cell/monitor_check/missing_monitors.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/remote/remote_program.h"
#include "supervisor/ltl/trace/judge.h"
#include "tests/st/machine.h"
#include "tests/support/controller/simulated_controller.h"
#include "tests/unit/cell/monitors/monitored.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::cell_monitors {
namespace {

using ::testing::HasSubstr;

// Letters of a generator that both engines run; none of eight places holds most of the time.
constexpr const char* kWalk = R"(PROGRAM main
VAR p1, p2, p3, p4, p5, p6, p7, p8 : BOOL; seed : UDINT := 7; place : UDINT; level : INT; END_VAR
seed := seed * 1664525 + 1013904223;
place := (seed / 65536) MOD 24;
p1 := place = 1; p2 := place = 2; p3 := place = 3; p4 := place = 4;
p5 := place = 5; p6 := place = 6; p7 := place = 7; p8 := place = 8;
level := UDINT_TO_INT((seed / 1048576) MOD 100);
END_PROGRAM
)";

// `let` of p1 .. p8.
std::string places(int n) {
  std::string text = "let = { ";
  for (int k = 1; k <= n; ++k)
    text += (k > 1 ? ", p" : "p") + std::to_string(k) + " = \"main.p" + std::to_string(k) + "\"";
  return text + " }\n";
}

double number_of(const reader::ProgramInfo& info, const st_test::Machine& machine, const std::string& tag) {
  const reader::Variable* found = info.find(tag);
  EXPECT_NE(found, nullptr) << tag;
  return found == nullptr ? -1.0 : reader::read_number(*found, machine.image());
}

TEST(CellMonitors, State_WhenTheFirstTaskIsWatched_ThenThatOfItsAutomatonInBothEngines) {
  const std::string formula = ltl::test::in_succession(8);
  const auto program =
      test::loaded_with("[[monitors]]\nname = \"row\"\nformula = \"" + formula + "\"\n" + places(8), kWalk);
  const auto parsed = ltl::parse_formula(formula);
  const auto automaton = ltl::monitor_automaton(*parsed)->automaton;
  const auto info = reader::ProgramInfo::read(program.bytes()).value();
  std::vector<std::uint64_t> hashes;
  for (const st_test::EngineKind engine : st_test::engines()) {
    st_test::Machine machine(program, engine);
    const reader::Variable state_at = *info.find("monitor_row.State"),
                           verdict_at = *info.find("monitor_row.Verdict");
    const reader::Variable left_at = *info.find("monitor_row.Left"),
                           reset_at = *info.find("monitor_row.Reset");
    std::uint32_t state = automaton.initial;
    int decided = 0;
    std::uint64_t hash = 0;
    for (int scan = 0; scan < 100'000; ++scan) {
      const bool anew = automaton.verdicts[state] != ltl::Verdict::Undecided;
      if (anew) machine.set("monitor_row.Reset", "TRUE");
      hash = hash * 31 + machine.scan().image_hash;
      ltl::Letter letter = 0;
      for (std::uint32_t k = 0; k < 8; ++k)
        if (number_of(info, machine, "main." + automaton.propositions[k]) != 0.0)
          letter |= ltl::Letter{1} << k;
      state = anew ? automaton.initial : automaton.next(state, letter);
      decided += anew ? 1 : 0;
      const double left =
          automaton.distance[state] == ltl::Automaton::kNever ? 65'535.0 : automaton.distance[state];
      ASSERT_EQ(reader::read_number(state_at, machine.image()), state) << scan;
      ASSERT_EQ(reader::read_number(verdict_at, machine.image()),
                static_cast<int>(automaton.verdicts[state]));
      ASSERT_EQ(reader::read_number(left_at, machine.image()), left);
      ASSERT_EQ(reader::read_number(reset_at, machine.image()), 0.0);
    }
    EXPECT_GT(decided, 1'000);
    hashes.push_back(hash);
  }
  EXPECT_EQ(hashes.front(), hashes.back());
}

// The scan in which each monitor is decided, as the scan has it and as `ltl check` has it of the trace.
TEST(CellMonitors, Verdict_WhenTheRunIsRecorded_ThenThatOfTheTraceInTheSameScan) {
  const std::vector<std::pair<std::string, bool>> formulas = {
      {"never p2 before p1", false},
      {"p1 then (p2 then p3)", false},
      {"s responds to p within T#80ms", true},
      {"never p for T#20ms", true},
      {"p1 within T#50ms", true},
      {"high for T#30ms precedes p8", true},
      {"G(p1 -> X (p2 | p3))", false},
      {"between p1 and p2: absent p3", false},
      {"visit (p1 | p2) within T#1s", true},
  };
  std::string toml;
  for (std::size_t k = 0; k < formulas.size(); ++k)
    toml += "[[monitors]]\nname = \"m" + std::to_string(k) + "\"\nformula = \"" + formulas[k].first + "\"\n";
  const std::string globals = "VAR_GLOBAL p, s, high, p1, p2, p3, p8 : BOOL; END_VAR\n" + std::string(kWalk);
  std::string text = globals;
  text.replace(text.find("VAR p1, p2, p3, p4, p5, p6, p7, p8 : BOOL;"), 42, "VAR p4, p5, p6, p7 : BOOL;");
  text.replace(text.find("END_PROGRAM"), 11,
               "p := place < 6; s := place > 18; high := level > 30;\nEND_PROGRAM");
  const auto program = test::loaded_with(toml, text);
  const auto info = reader::ProgramInfo::read(program.bytes()).value();
  st_test::Machine machine(program, st_test::EngineKind::Vm);
  std::vector<std::pair<int, double>> decided(formulas.size(), {0, 0.0});
  std::string csv = "scan,time_s,p,s,high,p1,p2,p3,p8\n";
  for (int scan = 1; scan <= 400; ++scan) {
    const auto report = machine.scan();
    csv += std::to_string(scan) + "," + std::to_string(static_cast<double>(report.time_ns) * 1e-9);
    for (const char* each : {"p", "s", "high", "p1", "p2", "p3", "p8"})
      csv += number_of(info, machine, each) != 0.0 ? ",1" : ",0";
    csv += "\n";
    for (std::size_t k = 0; k < formulas.size(); ++k) {
      const double verdict = number_of(info, machine, "monitor_m" + std::to_string(k) + ".Verdict");
      if (decided[k].first == 0 && verdict != 0.0) decided[k] = {scan, verdict};
    }
  }
  for (std::size_t k = 0; k < formulas.size(); ++k) {
    SCOPED_TRACE(formulas[k].first);
    const auto formula = ltl::parse_formula(formulas[k].first);
    ASSERT_TRUE(formula);
    EXPECT_EQ(!formula->tree.timed.empty(), formulas[k].second);
    const auto trace = ltl::read_trace(csv, "run.csv", formula->tree, {});
    ASSERT_TRUE(trace) << result::to_string(trace.error());
    const auto judged = ltl::judge(*formula, *trace)->whole;
    EXPECT_EQ(static_cast<int>(judged.verdict), static_cast<int>(decided[k].second));
    const int scan = judged.decided_at ? static_cast<int>(trace->changes[*judged.decided_at].row) : 0;
    EXPECT_EQ(scan, decided[k].first);
    EXPECT_GT(scan, 0) << "the run decides it";
  }
}

constexpr const char* kPress = R"(PROGRAM main
VAR at_wash : BOOL; level : INT; lamp AT %QX0.0 : BOOL; END_VAR
level := level + 1;
at_wash := level = 5;
lamp := TRUE;
END_PROGRAM
)";

TEST(CellMonitors, Scan_WhenTheFormulaFailsAndSafeStateIsAsked_ThenItEndsThereAndNamesTheMonitor) {
  const auto program = test::loaded_with(
      "[[monitors]]\nname = \"stop\"\nformula = \"never wash before press\"\non_false = [\"safe_state\", "
      "\"alarm\"]\n"
      "let = { wash = \"main.at_wash\", press = \"main.level >= 20\" }\n"
      "[[monitors]]\nname = \"told\"\nformula = \"never wash\"\nlet = { wash = \"main.at_wash\" }\n",
      kPress);
  for (const st_test::EngineKind engine : st_test::engines()) {
    st_test::Machine machine(program, engine);
    for (int scan = 1; scan < 5; ++scan) ASSERT_EQ(machine.scan().state, scan::ScanState::Running);
    EXPECT_TRUE(machine.equals("monitor_stop.Undecided", "TRUE"));
    const scan::ScanReport report = machine.scan();
    EXPECT_EQ(report.state, scan::ScanState::Trapped);
    EXPECT_EQ(report.trap.code, bytecode::TrapCode::UserTrap);
    EXPECT_THAT(result::to_string(reader::describe(program.program(), report.trap)),
                HasSubstr("monitor_stop"));
    EXPECT_TRUE(machine.equals("monitor_stop.Failed", "TRUE"));
    EXPECT_TRUE(machine.equals("monitor_told.Failed", "TRUE")) << "those that stop the scan run last";
    machine.restart_after_trap();
    EXPECT_EQ(machine.scan().state, scan::ScanState::Running);
    EXPECT_TRUE(machine.equals("monitor_stop.Failed", "FALSE"));
  }
}

// A program in which the washing and the pressing come in these scans; 0: never.
std::vector<std::byte> plan(int press, int wash, const std::string& name) {
  const auto cell = test::cell_of(
      "[[monitors]]\nname = \"dry\"\nformula = \"after press: absent wash\"\n"
      "let = { wash = \"at_wash\", press = \"at_press\" }\n");
  const auto container = test::compiled_with(
      cell, "VAR_GLOBAL at_wash, at_press : BOOL; END_VAR\nPROGRAM main VAR " + name + " : INT; END_VAR\n" +
                name + " := " + name + " + 1;\nat_press := " + name + " = " + std::to_string(press) +
                ";\nat_wash := " + name + " = " + std::to_string(wash) + ";\nEND_PROGRAM\n");
  EXPECT_TRUE(container) << result::to_string(container.error());
  return container ? *container : std::vector<std::byte>();
}

// What was before the change counts, except for one that has failed.
TEST(CellMonitors, State_WhenOnePlanRelievesAnother_ThenItGoesOnUnlessItHadFailed) {
  support::SimulatedController controller{assemblies::BenchParameters{}};
  int scans = 0;
  controller.on_scan = [&](std::span<const std::byte>) {
    if (++scans % 10 == 0) controller.interrupt();
  };
  std::vector<std::byte> running = plan(3, 0, "first");
  const auto verdict_behind = [&](int until) {
    for (scans = 0; scans < until;) {
      if (const auto event = controller.wait_event(std::chrono::milliseconds(1)))
        (void)controller.acknowledge(event->sequence);
    }
    const auto info = reader::ProgramInfo::read(running).value();
    return reader::read_number(*info.find("monitor_dry.Verdict"), controller.snapshot()->image);
  };
  const auto change = [&](std::vector<std::byte> next) {
    running = std::move(next);
    return controller.change(running).has_value();
  };
  ASSERT_TRUE(controller.download(running) && controller.start(false));
  EXPECT_EQ(verdict_behind(10), 0.0);
  ASSERT_TRUE(change(plan(0, 5, "second")));
  EXPECT_EQ(verdict_behind(10), 2.0) << "it was pressed by the plan before";
  ASSERT_TRUE(change(plan(0, 5, "third")));
  EXPECT_EQ(verdict_behind(10), 0.0) << "the next plan is judged by itself";
}

TEST(CellMonitors, Chart_WhenAViewerLooks_ThenVerdictsAreStepsAndTheFirstSaysTheFormula) {
  const auto program = test::loaded_with(
      "[[monitors]]\nname = \"no_wash\"\nformula = \"never wash\"\nlet = { wash = \"main.at_wash\" }\n",
      kPress);
  const auto info = reader::ProgramInfo::read(program.bytes()).value();
  const reader::ChartInfo* chart = info.chart("monitor_no_wash");
  ASSERT_NE(chart, nullptr);
  ASSERT_EQ(chart->steps.size(), 3u);
  EXPECT_TRUE(chart->steps[0].initial);
  EXPECT_EQ(chart->steps[0].comment, "never wash");
  EXPECT_EQ(chart->steps[2].name, "Failed");
}

constexpr const char* kTwoTasks = R"(PROGRAM fast VAR a : BOOL; END_VAR
a := NOT a;
END_PROGRAM
PROGRAM slow VAR b : BOOL; END_VAR
b := NOT b;
END_PROGRAM
CONFIGURATION c
  TASK quick(INTERVAL := T#1ms, PRIORITY := 1);
  TASK calm(INTERVAL := T#10ms, PRIORITY := 2);
  PROGRAM f1 WITH quick : fast;
  PROGRAM s1 WITH calm : slow;
END_CONFIGURATION
)";

TEST(CellMonitors, Task_WhenProgramsOfOneAreRead_ThenItRunsTheMonitorBehindThem) {
  const auto program = test::loaded_with(
      "[[monitors]]\nname = \"slow\"\nformula = \"never (b for T#1s)\"\nlet = { b = \"s1.b\" }\n", kTwoTasks);
  st_test::Machine machine(program, st_test::EngineKind::Vm);
  for (int scan = 0; scan < 10; ++scan) machine.scan();
  EXPECT_TRUE(machine.equals("monitor_slow.Since", "0") || machine.equals("monitor_slow.Since", "1"))
      << "one execution in ten scans: " << machine.shown("monitor_slow.Since");
}

TEST(CellMonitors, Controller_WhenItIsBehindModbus_ThenItTakesTheProgram) {
  const auto container = test::compiled_with(
      test::cell_of(
          "[[monitors]]\nname = \"stop\"\nformula = \"s responds to p within T#5s\"\n"
          "on_false = [\"safe_state\"]\nlet = { p = \"main.at_wash\", s = \"main.level >= 20\" }\n"),
      kPress);
  ASSERT_TRUE(container) << result::to_string(container.error());
  const auto remote = remote::RemoteProgram::create(*container, {});
  EXPECT_TRUE(remote) << result::to_string(remote.error());
}

TEST(CellMonitors, Sentence_WhenChecked_ThenFormulaSizeAndWhatHappens) {
  const auto monitors = cell_monitors(test::cell_of(
      "[[monitors]]\nname = \"a\"\nformula = \"never wash before press\"\non_false = [\"alarm\", \"event\"]\n"
      "[[monitors]]\nname = \"b\"\nformula = \"visit press\"\n"
      "[[monitors]]\nname = \"c\"\nformula = \"press within T#5s,  # in time\\n  never wash\"\n"));
  ASSERT_TRUE(monitors);
  EXPECT_EQ(
      sentence_of((*monitors)[0]),
      "never wash before press: 3 states over wash, press; when it fails: alarm, event to the supervisor");
  EXPECT_THAT(sentence_of((*monitors)[1]), HasSubstr("it cannot fail"));
  EXPECT_EQ((*monitors)[2].words, "press within T#5s, never wash");
}

TEST(CellMonitors, Program_WhenCompiledWithoutTheCell_ThenEachMissingMonitorIsTold) {
  const auto with = test::cell_of("[[monitors]]\nname = \"a\"\nformula = \"never main.at_wash\"\n");
  const auto bare = test::compiled_with({}, kPress), watched = test::compiled_with(with, kPress);
  ASSERT_TRUE(bare && watched);
  const auto missing = missing_monitors(with, reader::ProgramInfo::read(*bare).value());
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code, "C0558");
  EXPECT_EQ(missing[0].where.line, 3u);
  EXPECT_TRUE(missing_monitors(with, reader::ProgramInfo::read(*watched).value()).empty());
  // As bytes that nobody has looked at yet.
  EXPECT_EQ(missing_monitors(with, *bare).size(), 1u);
  EXPECT_TRUE(missing_monitors(with, *watched).empty());
  EXPECT_TRUE(missing_monitors({}, *bare).empty());
  EXPECT_TRUE(missing_monitors(with, std::span<const std::byte>()).empty()) << "the verifier says that";
}

}  // namespace
}  // namespace stepwright::cell_monitors
