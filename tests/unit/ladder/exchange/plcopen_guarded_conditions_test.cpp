// Drawn conditions are evaluated only while their transition is enabled: sfc_semantics.md, "Drawn
// conditions".

#include <gtest/gtest.h>

#include <string>

#include "ladder/driver/sheets.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "ladder/lowering/sfc_to_ladder.h"
#include "runtime/bytecode/reader/program_info.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

std::string in(const std::string& from, const std::string& output = "") {
  const std::string formal = output.empty() ? "" : " formalParameter=\"" + output + "\"";
  return "<connectionPointIn><connection refLocalId=\"" + from + "\"" + formal + "/></connectionPointIn>";
}

std::string at(const std::string& kind, const std::string& id, const std::string& attributes = "") {
  return "<" + kind + " localId=\"" + id + "\"" + attributes + "><position x=\"" + id + "\" y=\"" + id +
         "\"/>";
}

std::string value(const std::string& id, const std::string& expression) {
  return at("inVariable", id) + "<connectionPointOut/><expression>" + expression +
         "</expression></inVariable>\n";
}

std::string result(const std::string& id, const std::string& from, const std::string& output,
                   const std::string& name) {
  return at("outVariable", id) + in(from, output) + "<expression>" + name + "</expression></outVariable>\n";
}

std::string pin(const std::string& name, const std::string& connection) {
  return "<variable formalParameter=\"" + name + "\">" + connection + "</variable>";
}

std::string block(const std::string& id, const std::string& type, const std::string& inputs,
                  const std::string& output, const std::string& instance = "") {
  const std::string name = instance.empty() ? "" : " instanceName=\"" + instance + "\"";
  return at("block", id, " typeName=\"" + type + "\"" + name) + "<inputVariables>" + inputs +
         "</inputVariables><inOutVariables/><outputVariables>" + pin(output, "<connectionPointOut/>") +
         "</outputVariables></block>\n";
}

// 10 / d > 2, the quotient at OUT of block 43; where `shared`, read twice: 10 / d > 2 AND 10 / d < 100.
std::string quotient(bool shared = false) {
  std::string text = value("40", "10") + value("41", "d") +
                     block("42", "DIV", pin("IN1", in("40")) + pin("IN2", in("41")), "OUT") +
                     value("44", "2") +
                     block("43", "GT", pin("IN1", in("42", "OUT")) + pin("IN2", in("44")), "OUT");
  if (shared)
    text += value("45", "100") +
            block("46", "LT", pin("IN1", in("42", "OUT")) + pin("IN2", in("45")), "OUT") +
            block("47", "AND", pin("IN1", in("43", "OUT")) + pin("IN2", in("46", "OUT")), "OUT");
  return text;
}

std::string fbd(const std::string& elements) {
  return "<FBD>" + elements + "</FBD>";
}

std::string inlined(const std::string& st) {
  return "<inline name=\"\"><ST><xhtml:p>" + st + "</xhtml:p></ST></inline>";
}

std::string step(const std::string& id, const std::string& name, const std::string& from) {
  return at("step", id, " name=\"" + name + "\" initialStep=\"" + (from.empty() ? "true" : "false") + "\"") +
         (from.empty() ? "" : in(from)) + "<connectionPointOut formalParameter=\"\"/>" +
         "<connectionPointOutAction formalParameter=\"\"/></step>\n";
}

std::string transition(const std::string& id, const std::string& from, const std::string& condition) {
  return at("transition", id) + in(from) + "<connectionPointOut/><condition>" + condition +
         "</condition></transition>\n";
}

std::string jump(const std::string& id, const std::string& from, const std::string& to) {
  return at("jumpStep", id, " targetName=\"" + to + "\"") + in(from) + "</jumpStep>\n";
}

std::string typed(const std::string& name, const std::string& type) {
  return "<variable name=\"" + name + "\"><type>" + type + "</type></variable>";
}

struct Drawn {
  std::string condition;    // of the transition from S1 to S2
  std::string beside{};     // elements beside the chart
  std::string named{};      // <transition name="cond"> ...
  std::string second = "";  // condition of a transition from S0 to S2; none if empty
};

// S0 -go-> S1 -condition-> S2 -back-> S0.
std::string project(const Drawn& drawn) {
  std::string chart = step("1", "S0", "") + transition("2", "1", inlined("go")) + step("3", "S1", "2") +
                      transition("4", "3", drawn.condition) + step("5", "S2", "4") +
                      transition("6", "5", inlined("back")) + jump("7", "6", "S0");
  if (!drawn.second.empty()) chart += transition("8", "1", drawn.second) + jump("9", "8", "S2");
  const std::string variables = bools("go back a b") + typed("d", "<DINT/>") + typed("n", "<DINT/>") +
                                typed("timer", "<derived name=\"TON\"/>") +
                                typed("k", "<derived name=\"Counter\"/>");
  return editor_project("<pou name=\"main\" pouType=\"program\"><interface><localVars>" + variables +
                        "</localVars></interface>" +
                        (drawn.named.empty() ? ""
                                             : "<transitions><transition name=\"cond\"><body>" + drawn.named +
                                                   "</body></transition></transitions>") +
                        "<body><SFC>\n" + chart + drawn.beside + "</SFC></body></pou>\n");
}

driver::CompileInput input_with_counter(const graphic::Project& project) {
  driver::CompileInput input;
  input.texts.push_back(
      {"counter.st",
       "FUNCTION_BLOCK Counter VAR_INPUT limit : DINT; END_VAR VAR_OUTPUT q : BOOL; n : DINT; "
       "END_VAR n := n + 1; q := n > limit; END_FUNCTION_BLOCK\n"});
  input.projects = {&project};
  return input;
}

class ProjectRun {
 public:
  explicit ProjectRun(const Drawn& drawn) : ProjectRun(read(project(drawn))) {}
  explicit ProjectRun(graphic::Project project)
      : project_(std::move(project)), program_(input_with_counter(project_)) {}

  void set(const std::string& name, std::int64_t value) { program_.set("run." + name, value); }
  std::int64_t get(const std::string& name) const { return program_.get("run." + name); }
  bool scan() { return !program_.scan().trap; }

  // One character per scan.
  std::string trace(const std::string& name, const std::string& go, const std::string& back = "") {
    std::string text;
    for (std::size_t i = 0; i < go.size(); ++i) {
      set("go", go[i] == '1');
      set("back", i < back.size() && back[i] == '1');
      text += scan() ? static_cast<char>('0' + get(name)) : '!';
    }
    return text;
  }

 private:
  static graphic::Project read(const std::string& xml) {
    auto project = read_plcopen("plc.xml", xml);
    if (!project) throw std::runtime_error(result::to_string(project.error()));
    return std::move(*project);
  }
  graphic::Project project_;
  support::CompiledProgram program_;
};

std::string connection(const std::string& from, const std::string& output = "OUT") {
  return in(from, output);
}

// SFC-C-1
TEST(GuardedCondition, WhenANetworkDivides_ThenOnlyWhileItsTransitionIsEnabled) {
  const std::string named = "<reference name=\"cond\"/>";
  const Drawn forms[] = {
      {connection("43"), quotient()},
      {connection("47"), quotient(true)},
      {named, "", fbd(quotient() + result("48", "43", "OUT", "cond"))},
      {named, "", fbd(quotient(true) + result("48", "47", "OUT", "cond"))},
      {"<inline name=\"cond\">" + fbd(quotient(true) + result("48", "47", "OUT", "cond")) + "</inline>"},
      {inlined("10 / d &gt; 2")},
  };
  for (const Drawn& each : forms) {
    SCOPED_TRACE(project(each));
    ProjectRun fires(each);
    EXPECT_EQ(fires.trace("S2_X", "000"), "000");
    fires.set("d", 2);
    EXPECT_EQ(fires.trace("S2_X", "010"), "001");
    ProjectRun traps(each);
    EXPECT_EQ(traps.trace("S1_X", "0010"), "001!");
  }
}

std::string timed(const std::string& name) {
  return fbd(value("40", "TRUE") + value("41", "T#40ms") +
             block("42", "TON", pin("IN", in("40")) + pin("PT", in("41")), "Q", "timer") +
             result("43", "42", "Q", name));
}

// SFC-C-6
TEST(GuardedCondition, WhenATimerIsInItsNetwork_ThenItIsCalledOnlyWhileItIsEnabled) {
  ProjectRun run({"<reference name=\"cond\"/>", "", timed("cond")});
  EXPECT_EQ(run.trace("S2_X", "00001"), "00000");
  EXPECT_EQ(run.get("timer.ET"), 0);
  // It starts in the first scan of the step that tests it, 20 ms each ...
  EXPECT_EQ(run.trace("S2_X", "00000", "00001"), "00110");
  // ... and does not see that the step was left.
  EXPECT_EQ(run.trace("S2_X", "100"), "011");
}

// SFC-C-7
TEST(GuardedCondition, WhenTwoTransitionsNameANetwork_ThenItRunsOnceInAScanThatNeedsIt) {
  const std::string counts = fbd(value("40", "2") + block("42", "Counter", pin("limit", in("40")), "q", "k") +
                                 result("43", "42", "q", "cond"));
  ProjectRun run({"<reference name=\"cond\"/>", "", counts, "<reference name=\"cond\"/>"});
  // S0 and S1 ask for it, S2 does not.
  EXPECT_EQ(run.trace("k.n", "00100000"), "01233333");
  EXPECT_EQ(run.get("S2_X"), 1);
}

// SFC-C-8
TEST(GuardedCondition, WhenAContactSensesAnEdge_ThenItIsThatOfItsVariableInEveryScan) {
  const std::string contact = at("leftPowerRail", "49") +
                              "<connectionPointOut formalParameter=\"\"/></leftPowerRail>" +
                              at("contact", "50", " edge=\"rising\"") + in("49") +
                              "<connectionPointOut/><variable>a</variable></contact>";
  const std::string both = block("51", "AND", pin("IN1", in("50")) + pin("IN2", in("43", "OUT")), "OUT");
  const Drawn forms[] = {
      {connection("51"), quotient() + contact + both},
      {"<reference name=\"cond\"/>", "",
       fbd(quotient(true) + contact +
           block("51", "AND", pin("IN1", in("50")) + pin("IN2", in("47", "OUT")), "OUT") +
           result("52", "51", "OUT", "cond"))},
  };
  for (const Drawn& each : forms) {
    ProjectRun run(each);
    run.set("d", 2);
    run.set("a", 1);
    EXPECT_EQ(run.trace("S2_X", "0010000"), "0000000");
    run.set("a", 0);
    EXPECT_EQ(run.trace("S2_X", "0"), "0");
    run.set("a", 1);
    EXPECT_EQ(run.trace("S2_X", "00"), "11");
  }
}

// SFC-C-9
TEST(GuardedCondition, WhenATimerStandsBesideTheChart_ThenItRunsInEveryScan) {
  const std::string beside = value("40", "S1.X") + value("41", "T#40ms") +
                             block("42", "TON", pin("IN", in("40")) + pin("PT", in("41")), "Q", "timer");
  ProjectRun run({connection("42", "Q"), beside});
  EXPECT_EQ(run.trace("S2_X", "0010000"), "0000011");
  EXPECT_EQ(run.trace("S2_X", "0001000", "1000000"), "0000001");
}

TEST(GuardedCondition, WhenItsNetworkJumps_ThenItIsRefused) {
  const std::string jumps = fbd(quotient() + result("48", "43", "OUT", "cond") + at("return", "60") +
                                "<connectionPointIn/></return>");
  const auto xml = project({"<reference name=\"cond\"/>", "", jumps});
  const auto read = read_plcopen("plc.xml", xml);
  ASSERT_TRUE(read) << result::to_string(read.error());
  driver::CompileInput input;
  input.projects = {&*read};
  const auto output = driver::compile(input);
  ASSERT_FALSE(output);
  EXPECT_NE(result::to_string(output.error()).find("E0804: POU 'main': jumps and labels in a transition"),
            std::string::npos)
      << result::to_string(output.error());
}

// The listing and the container name what was drawn, not the wires of its evaluation.
TEST(GuardedCondition, WhenTheChartIsShown_ThenItsConditionsAreAsTheyWereDrawn) {
  const std::string named = "<reference name=\"cond\"/>";
  const std::string shared = "(AND(GT(DIV(10, d), 2), LT(DIV(10, d), 100)))";
  const std::pair<Drawn, std::string> forms[] = {
      {{connection("43"), quotient()}, "(GT(DIV(10, d), 2))"},
      {{connection("47"), quotient(true)}, shared},
      {{named, "", fbd(quotient(true) + result("48", "47", "OUT", "cond"))}, shared},
      {{"<inline name=\"cond\">" + fbd(quotient(true) + result("48", "47", "OUT", "cond")) + "</inline>"},
       shared},
  };
  for (const auto& [drawn, condition] : forms) {
    SCOPED_TRACE(project(drawn));
    const auto read = read_plcopen("plc.xml", project(drawn));
    ASSERT_TRUE(read) << result::to_string(read.error());
    const driver::CompileInput input = input_with_counter(*read);
    const auto sheets = driver::sheets_of(input);
    ASSERT_TRUE(sheets) << result::to_string(sheets.error());
    const auto* chart = std::get_if<graphic::SfcChart>(&sheets->at(1).body);
    ASSERT_NE(chart, nullptr);
    EXPECT_EQ(to_st(chart->transitions[1].condition), condition);
    const auto output = driver::compile(input);
    ASSERT_TRUE(output) << result::to_string(output.error());
    const auto info = reader::ProgramInfo::read(output->container);
    ASSERT_TRUE(info);
    EXPECT_EQ(info->charts().front().transitions[1].condition, condition);
  }
}

// SFC-C-5
TEST(GuardedCondition, WhenTheLoweredChartIsWrittenAsALadder_ThenItDoesNotTrapEither) {
  graphic::SfcChart chart;
  for (const char* name : {"S0", "S1", "S2"}) {
    graphic::Step step;
    step.name = name;
    step.initial = chart.steps.empty();
    chart.steps.push_back(std::move(step));
  }
  const auto lead = [&](std::uint32_t from, std::uint32_t to, const char* text) {
    graphic::Transition each;
    each.sources = {graphic::StepId(from)};
    each.targets = {graphic::StepId(to)};
    each.condition.kind = graphic::ConditionKind::Expression;
    each.condition.name = text;
    chart.transitions.push_back(std::move(each));
  };
  lead(0, 1, "go");
  lead(1, 2, "10 / d > 2");
  graphic::Project project;
  graphic::Pou pou;
  pou.name = "main";
  pou.variables = {{"go", "BOOL"}, {"back", "BOOL"}, {"d", "DINT"}};
  pou.body = std::move(chart);
  project.pous = {pou};
  project.tasks.push_back({"t", 20'000});
  project.instances.push_back({"run", "main", "t"});
  const auto lowered = lowering::lower_sfc(project);
  ASSERT_TRUE(lowered) << result::to_string(lowered.error());
  const auto xml = write_plcopen(*lowered);
  ASSERT_TRUE(xml) << result::to_string(xml.error());
  auto copy = read_plcopen("copy.xml", *xml);
  ASSERT_TRUE(copy) << result::to_string(copy.error());
  ProjectRun run(std::move(*copy));
  EXPECT_EQ(run.trace("S1_X", "0010"), "001!");
}

}  // namespace
}  // namespace stepwright::exchange
