#include "ladder/driver/compile.h"

#include <gtest/gtest.h>

#include <thread>

#include "runtime/bytecode/reader/program_info.h"

namespace {

using namespace stepwright;

driver::CompileInput input_of(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"t.st", text});
  return input;
}

const char* const kProgram =
    "TYPE P : STRUCT a, b : INT; END_STRUCT END_TYPE\nPROGRAM main\nVAR t : TON; RETAINED : BOOL; n : DINT; "
    "p : P;"
    " q : ARRAY[1..2] OF P; s AT %QX0.1 : BOOL; END_VAR\nVAR RETAIN k : INT; END_VAR\nt(IN := NOT s, PT := "
    "T#1s);\n"
    "n := n + 1;\ns := t.Q;\nEND_PROGRAM\n";

TEST(Compile, Output_WhenCompiledTwice_ThenBytesAreEqual) {
  const auto first = driver::compile(input_of(kProgram));
  const auto second = driver::compile(input_of(kProgram));
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->container, second->container);
}

TEST(Compile, Output_WhenTheProgramChanges_ThenTheContainerChanges) {
  const auto first = driver::compile(input_of("PROGRAM main VAR x : INT; END_VAR x := 1; END_PROGRAM"));
  const auto second = driver::compile(input_of("PROGRAM main VAR x : INT; END_VAR x := 2; END_PROGRAM"));
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->container, second->container);
}

TEST(Compile, Output_WhenThreadsCompileAtOnce_ThenAllAgree) {
  const auto reference = driver::compile(input_of(kProgram));
  ASSERT_TRUE(reference);
  std::vector<std::vector<std::byte>> results(4);
  std::vector<std::thread> threads;
  for (auto& each : results)
    threads.emplace_back([&each] { each = driver::compile(input_of(kProgram))->container; });
  for (auto& each : threads) each.join();
  for (const auto& each : results) EXPECT_EQ(each, reference->container);
}

TEST(Compile, Symbols_WhenRead_ThenEveryVariableHasItsPath) {
  const auto output = driver::compile(input_of(kProgram));
  ASSERT_TRUE(output);
  const auto info = reader::ProgramInfo::read(output->container);
  ASSERT_TRUE(info);
  for (const char* path : {"main.t.Q", "main.t.ET", "main.n", "main.p.b", "main.q[2].a", "main.s", "main.k"})
    EXPECT_NE(info->find(path), nullptr) << path;
  EXPECT_EQ(info->find("main.s")->bit, 1);
}

graphic::Project chart_project() {
  graphic::Project project;
  project.name = "cell";
  graphic::Variable start;
  start.name = "start";
  start.type = "BOOL";
  start.address = "%IX0.0";
  project.globals = {start};
  graphic::Pou pou;
  pou.name = "plan";
  graphic::Variable pump;
  pump.name = "pump";
  pump.type = "BOOL";
  pump.section = graphic::VariableSection::Output;
  pou.variables = {pump};
  graphic::SfcChart chart;
  chart.steps = {{"Idle", true, {}, "", {}},
                 {"Load", false, {{graphic::Qualifier::N, "pump", "", ""}}, "(load)", {}}};
  graphic::Transition go{"go", {graphic::StepId(0)}, {graphic::StepId(1)}, graphic::contact("start"), 0, "",
                         {}};
  graphic::Transition back{
      "back", {graphic::StepId(1)}, {graphic::StepId(0)}, graphic::contact("start", true), 0, "", {}};
  chart.transitions = {go, back};
  pou.body = chart;
  project.pous = {pou};
  project.tasks = {{"main_task", 20'000, 1}};
  project.instances = {{"bench", "plan", "main_task"}};
  return project;
}

TEST(Compile, Project_WhenItHoldsAChart_ThenTheContainerDescribesIt) {
  const graphic::Project project = chart_project();
  driver::CompileInput input;
  input.projects = {&project};
  const auto output = driver::compile(input);
  ASSERT_TRUE(output) << result::to_string(output.error());
  const auto info = reader::ProgramInfo::read(output->container);
  ASSERT_TRUE(info);
  ASSERT_EQ(info->charts().size(), 1u);
  EXPECT_EQ(info->charts()[0].name, "bench");
  ASSERT_EQ(info->charts()[0].steps.size(), 2u);
  EXPECT_EQ(info->charts()[0].steps[1].comment, "(load)");
  EXPECT_TRUE(info->charts()[0].steps[0].initial);
  EXPECT_EQ(info->charts()[0].transitions[1].condition, "NOT start");
  EXPECT_EQ(info->charts()[0].transitions[1].sources, (std::vector<std::uint32_t>{1}));
  EXPECT_NE(info->find("bench.pump"), nullptr);
  EXPECT_NE(info->find("start"), nullptr);
}

TEST(Compile, Project_WhenARungIsWrong_ThenTheRungIsNamed) {
  graphic::Project project;
  graphic::Pou pou;
  pou.name = "main";
  graphic::LadderProgram ladder;
  ladder.rungs.resize(2);
  ladder.rungs[1].condition = graphic::contact("missing");
  ladder.rungs[1].coils = {{graphic::CoilKind::Normal, "%QX0.0"}};
  pou.body = ladder;
  project.pous = {pou};
  driver::CompileInput input;
  input.projects = {&project};
  const auto output = driver::compile(input);
  ASSERT_FALSE(output);
  ASSERT_EQ(output.error().size(), 1u);
  EXPECT_EQ(output.error()[0].code, "E0201");
  EXPECT_EQ(output.error()[0].where.file, "main.ld");
  EXPECT_EQ(output.error()[0].where.line, 2u);
}

TEST(Compile, NoInput_WhenCompiled_ThenThereIsNoProgram) {
  const auto output = driver::compile({});
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error()[0].code, "E0601");
}

}  // namespace
