#include "ladder/lowering/ladder_to_syntax.h"

#include <gtest/gtest.h>

#include "tests/support/compiled_program.h"

namespace {

using namespace stepwright;
using graphic::CoilKind;
using graphic::contact;

graphic::Variable variable(const char* name, const char* type) {
  graphic::Variable result;
  result.name = name;
  result.type = type;
  return result;
}

// A project with one program of these rungs and BOOL a, b, c, q, p and INT n, m and TON t.
graphic::Project project_of(graphic::LadderProgram ladder,
                            graphic::PouKind kind = graphic::PouKind::Program) {
  graphic::Project project;
  graphic::Pou pou;
  pou.name = "main";
  pou.kind = kind;
  for (const char* name : {"a", "b", "c", "q", "p"}) pou.variables.push_back(variable(name, "BOOL"));
  for (const char* name : {"n", "m"}) pou.variables.push_back(variable(name, "INT"));
  if (kind != graphic::PouKind::Function) pou.variables.push_back(variable("t", "TON"));
  pou.result_type = "BOOL";
  pou.body = std::move(ladder);
  project.pous.push_back(pou);
  return project;
}

driver::CompileInput input_of(const graphic::Project& project) {
  driver::CompileInput input;
  input.projects = {&project};
  return input;
}

graphic::Rung rung(graphic::Condition condition, CoilKind kind, const char* coil) {
  graphic::Rung result;
  result.condition = std::move(condition);
  result.coils.push_back({kind, coil});
  return result;
}

graphic::Condition edge(const char* name, graphic::Edge which) {
  graphic::Condition result = contact(name);
  result.edge = which;
  return result;
}

// What `q` is after each scan when `a` has these values.
std::string trace(graphic::LadderProgram ladder, const std::string& inputs, const char* output = "main.q") {
  const graphic::Project project = project_of(std::move(ladder));
  support::CompiledProgram program(input_of(project));
  std::string seen;
  for (const char value : inputs) {
    program.set("main.a", value - '0');
    EXPECT_FALSE(program.scan().trap);
    seen += program.get(output) != 0 ? '1' : '0';
  }
  return seen;
}

struct CoilCase {
  const char* name;
  CoilKind kind;
  const char* inputs;
  const char* outputs;
};

class Coil : public testing::TestWithParam<CoilCase> {};

TEST_P(Coil, Coil_WhenAloneInItsRung_ThenFollowsItsKind) {
  EXPECT_EQ(trace({{rung(contact("a"), GetParam().kind, "q")}}, GetParam().inputs), GetParam().outputs);
}

TEST_P(Coil, Coil_WhenBesideAnotherCoil_ThenFollowsItsKind) {
  graphic::Rung both = rung(contact("a"), CoilKind::Normal, "b");
  both.coils.push_back({GetParam().kind, "q"});
  EXPECT_EQ(trace({{both}}, GetParam().inputs), GetParam().outputs);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Coil,
                         testing::Values(CoilCase{"Normal", CoilKind::Normal, "01101", "01101"},
                                         CoilCase{"Negated", CoilKind::Negated, "01101", "10010"},
                                         CoilCase{"Set", CoilKind::Set, "00100", "00111"},
                                         CoilCase{"RisingEdge", CoilKind::RisingEdge, "0110110", "0100100"},
                                         CoilCase{"FallingEdge", CoilKind::FallingEdge, "0110010", "0001001"},
                                         CoilCase{"RisingAtStart", CoilKind::RisingEdge, "110", "100"}),
                         [](const auto& each) { return each.param.name; });

TEST(LadderToSyntax, ResetCoil_WhenPowered_ThenResetsWhatWasSet) {
  const graphic::LadderProgram ladder{
      {rung(contact("a", true), CoilKind::Set, "q"), rung(contact("a"), CoilKind::Reset, "q")}};
  EXPECT_EQ(trace(ladder, "01001"), "10110");
}

TEST(LadderToSyntax, EdgeContact_WhenItsVariableChanges_ThenPowersOneScan) {
  EXPECT_EQ(trace({{rung(edge("a", graphic::Edge::Rising), CoilKind::Normal, "q")}}, "0110110"), "0100100");
  EXPECT_EQ(trace({{rung(edge("a", graphic::Edge::Falling), CoilKind::Normal, "q")}}, "0110010"), "0001001");
}

TEST(LadderToSyntax, Branches_WhenParallelAndInSeries_ThenAsDrawn) {
  graphic::LadderProgram ladder;
  ladder.rungs.push_back(rung(graphic::always(), CoilKind::Normal, "b"));
  ladder.rungs.push_back(
      rung(graphic::all({graphic::any({contact("a"), contact("c")}), contact("b")}), CoilKind::Normal, "q"));
  EXPECT_EQ(trace(ladder, "010"), "010");
}

TEST(LadderToSyntax, Jump_WhenPowered_ThenRungsAreSkipped) {
  graphic::LadderProgram ladder;
  ladder.rungs.resize(1);
  ladder.rungs[0].condition = contact("a");
  ladder.rungs[0].jump_to = "over";
  ladder.rungs.push_back(rung(graphic::always(), CoilKind::Negated, "q"));
  ladder.rungs.push_back(rung(graphic::always(), CoilKind::Normal, "q"));
  ladder.rungs[1].coils[0].variable = "p";
  ladder.rungs[2].label = "over";
  EXPECT_EQ(trace(ladder, "10"), "11");
  graphic::LadderProgram toggled = ladder;
  toggled.rungs[1] = rung(graphic::always(), CoilKind::Normal, "p");
  EXPECT_EQ(trace(toggled, "100", "main.p"), "011");
}

TEST(LadderToSyntax, Return_WhenPowered_ThenLeaves) {
  graphic::LadderProgram ladder;
  ladder.rungs.resize(1);
  ladder.rungs[0].condition = contact("a");
  ladder.rungs[0].is_return = true;
  ladder.rungs.push_back(rung(graphic::always(), CoilKind::Normal, "q"));
  EXPECT_EQ(trace(ladder, "10"), "01");
}

TEST(LadderToSyntax, Blocks_WhenEnabled_ThenFunctionsBlocksAndStatementsRun) {
  graphic::LadderProgram ladder;
  graphic::Rung rung1;
  rung1.condition = contact("a");
  graphic::Block timer;
  timer.type = "TON";
  timer.instance = "t";
  timer.power_input = "IN";
  timer.inputs = {{"PT", "T#20ms"}};
  timer.outputs = {{"Q", "q"}};
  graphic::Block add;
  add.type = "ADD";
  add.inputs = {{"", "n"}, {"", "2"}};
  add.outputs = {{"", "n"}, {"ENO", "p"}};
  graphic::Block text;
  text.st_body = "m := m + 1; // counts\nm := m + 10;";
  rung1.blocks = {timer, add, text};
  ladder.rungs.push_back(rung1);
  const graphic::Project project = project_of(ladder);
  support::CompiledProgram program(input_of(project));
  for (const int value : {0, 1, 1, 1}) {
    program.set("main.a", value);
    program.scan();
  }
  EXPECT_EQ(program.get("main.q"), 1);
  EXPECT_EQ(program.get("main.n"), 6);
  EXPECT_EQ(program.get("main.m"), 33);
  EXPECT_EQ(program.get("main.p"), 1);
}

result::Diagnostics errors_of(const graphic::Project& project) {
  const auto output = driver::compile(input_of(project));
  return output ? result::Diagnostics() : output.error();
}

TEST(LadderToSyntax, Jump_WhenTheLabelIsMissing_ThenTheRungIsNamed) {
  graphic::LadderProgram ladder;
  ladder.rungs.push_back(rung(contact("a"), CoilKind::Normal, "q"));
  ladder.rungs.push_back({});
  ladder.rungs[1].jump_to = "nowhere";
  const auto errors = errors_of(project_of(ladder));
  ASSERT_EQ(errors.size(), 1u) << result::to_string(errors);
  EXPECT_EQ(errors[0].code, "E0701");
  EXPECT_EQ(errors[0].where.line, 2u);
}

TEST(LadderToSyntax, Contact_WhenItHoldsAnExpression_ThenItKeepsTogether) {
  const auto with = [](graphic::Condition condition) {
    graphic::LadderProgram ladder{
        {rung(graphic::always(), CoilKind::Normal, "b"), rung(std::move(condition), CoilKind::Normal, "q")}};
    return trace(std::move(ladder), "0110");
  };
  EXPECT_EQ(with(graphic::all({contact("b OR a"), contact("a")})), "0110");
  EXPECT_EQ(with(contact("a AND c OR b", true)), "0000");
  EXPECT_EQ(with(edge("b OR a", graphic::Edge::Rising)), "1000");
  EXPECT_EQ(with(graphic::compare("b OR a", graphic::CompareOp::Equal, "a AND b // it's")), "0110");
}

TEST(LadderToSyntax, Texts_WhenTheyAreNotWhole_ThenTheRungIsNamed) {
  const auto error_of = [](graphic::Rung broken) {
    graphic::LadderProgram ladder{{rung(contact("a"), CoilKind::Normal, "q"), std::move(broken)}};
    const auto errors = errors_of(project_of(std::move(ladder)));
    return errors.empty()
               ? "compiles"
               : errors[0].where.file + ":" + std::to_string(errors[0].where.line) + " " + errors[0].code;
  };
  for (const char* text : {"a) OR (b", "a (* b", "a; q := TRUE", "a, b", ""}) {
    EXPECT_EQ(error_of(rung(contact(text), CoilKind::Normal, "p")).substr(0, 9), "main.ld:2") << text;
    EXPECT_EQ(error_of(rung(contact("a"), CoilKind::Normal, text)).substr(0, 9), "main.ld:2") << text;
  }
  const auto with = [](graphic::Block block) {
    graphic::Rung result;
    result.condition = contact("a");
    result.blocks.push_back(std::move(block));
    return result;
  };
  for (const char* text : {"n := 1; END_IF; n := 2; IF a THEN n := 3", "n := 1 (*", "END_IF", "n := 'a"}) {
    graphic::Block statements;
    statements.st_body = text;
    EXPECT_EQ(error_of(with(statements)).substr(0, 9), "main.ld:2") << text;
  }
  graphic::Block call;
  call.type = "ADD";
  call.inputs = {{"", "n"}, {"", "2, 3"}};
  call.outputs = {{"", "n"}};
  EXPECT_EQ(error_of(with(call)), "main.ld:2 E0104");
  call.inputs[1].second = "2 // two";
  EXPECT_EQ(error_of(with(call)), "compiles");
}

TEST(LadderToSyntax, Edge_WhenInAFunction_ThenIsRefused) {
  graphic::Project project = project_of({{rung(edge("a", graphic::Edge::Rising), CoilKind::Normal, "q")}},
                                        graphic::PouKind::Function);
  const auto errors = errors_of(project);
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors[0].code, "E0702");
}

TEST(LadderToSyntax, Trap_WhenARungDivides_ThenTheRungIsTheLine) {
  graphic::LadderProgram ladder;
  ladder.rungs.push_back(rung(contact("a"), CoilKind::Normal, "q"));
  graphic::Block text;
  text.st_body = "n := 1 / m;";
  ladder.rungs.push_back({});
  ladder.rungs[1].blocks = {text};
  const graphic::Project project = project_of(ladder);
  support::CompiledProgram program(input_of(project));
  const auto report = program.scan();
  ASSERT_TRUE(report.trap);
  const auto where =
      reader::source_location(program.loaded().program(), report.trap.function, report.trap.pc);
  EXPECT_EQ(where.file, "main.ld");
  EXPECT_EQ(where.line, 2u);
}

}  // namespace
