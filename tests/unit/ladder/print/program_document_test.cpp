#include "ladder/print/program_document.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ladder/driver/compile.h"
#include "ladder/driver/sheets.h"
#include "runtime/bytecode/reader/document_text.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/writer/document_section.h"

namespace stepwright::print {
namespace {

using nlohmann::json;

driver::CompileInput input_of(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"t.st", text});
  return input;
}

json document_of(const std::string& text) {
  return json::parse(program_document(driver::sheets_of(input_of(text)).value()));
}

// "path access line:column" of each use of the sheet.
std::string uses_of(const json& sheet) {
  std::string text;
  for (const json& use : sheet["uses"]) {
    text += use[0].get<std::string>() + " " + use[1].get<std::string>() + " " + use[2].dump() + "/" +
            use[3].dump() + ":" + use[4].dump() + "; ";
  }
  return text;
}

TEST(ProgramDocument, WhenABodyIsText_ThenItsLinesAndTheUsesInThemAreThere) {
  const json sheet = document_of(
      "PROGRAM main\nVAR n : INT; t : TON; a : ARRAY[1..2, 1..2] OF INT; END_VAR\n"
      "n := ABS(n) + a[1, 2];\n  t(IN := n > 1, PT := T#1s);\nEND_PROGRAM\n")["sheets"][0];
  EXPECT_EQ(sheet["name"], "main");
  EXPECT_EQ(sheet["language"], "ST");
  EXPECT_EQ(sheet["blocks"][0]["first"], 3);
  EXPECT_EQ(sheet["blocks"][0]["lines"][1], "  t(IN := n > 1, PT := T#1s);");
  EXPECT_EQ(sheet["variables"][1]["type"], "TON");
  EXPECT_EQ(uses_of(sheet),
            "n write 0/1:1; n read 0/1:10; a[1][2] read 0/1:15; t call 0/2:3; n read 0/2:11; ");
}

TEST(ProgramDocument, WhenADeclarationHasPragmas_ThenWhatTheySayIsWithItsVariables) {
  const json variables = document_of(
      "PROGRAM main\nVAR\n"
      "  {group := 'buffer'}\n"
      "  level, other : REAL {decimals := 1}; {unit := '°C', range := -5..1_00.5} // how full {unit := 'x'}\n"
      "  open : BOOL; (* of the\n valve *) {Values := ['shut', 'it$'s']} {no_warning}\n"
      "  {description := 'pieces $$5', unit := 'pcs'} n : INT; bare : INT;\n"
      "  s : STRUCT a : INT; {unit := 'm'} END_STRUCT; t : STRING := '{unit := $'q$'}';\n"
      "END_VAR\nlevel := other;\nEND_PROGRAM\n")["sheets"][0]["variables"];
  const json buffer = {{"unit", "°C"}, {"group", "buffer"}, {"decimals", 1}, {"range", {-5.0, 100.5}}};
  EXPECT_EQ(variables[0]["note"], buffer);
  EXPECT_EQ(variables[1]["note"], buffer);
  EXPECT_EQ(variables[0]["comment"], "how full {unit := 'x'}");
  EXPECT_EQ(variables[2]["note"], json({{"values", {"shut", "it's"}}}));
  EXPECT_EQ(variables[2]["comment"], "of the valve");
  EXPECT_EQ(variables[3]["note"], json({{"unit", "pcs"}, {"description", "pieces $5"}}));
  for (int i = 4; i < 7; ++i) EXPECT_FALSE(variables[i].contains("note")) << variables[i];
}

TEST(ProgramDocument, WhenABodyIsAChart_ThenStepsTransitionsAndActionsAreBlocks) {
  const json sheet = document_of(
      "PROGRAM main\nVAR go, lamp : BOOL; END_VAR\nINITIAL_STEP a: END_STEP\nSTEP b: lamp(N); count(P1); "
      "END_STEP\n"
      "TRANSITION FROM a TO b := go AND NOT b.X; END_TRANSITION\nTRANSITION FROM b TO a := TRUE; "
      "END_TRANSITION\n"
      "ACTION count: go := FALSE; END_ACTION\nEND_PROGRAM\n")["sheets"][0];
  std::string kinds;
  for (const json& block : sheet["blocks"]) kinds += block["kind"].get<std::string>() + " ";
  EXPECT_EQ(kinds, "step step transition transition action ");
  EXPECT_EQ(sheet["blocks"][1]["actions"][1]["qualifier"], "P1");
  EXPECT_EQ(sheet["blocks"][2]["to"], json({1}));
  EXPECT_EQ(uses_of(sheet),
            "lamp write 1/0:0; count write 1/0:0; go read 2/1:1; b.X read 2/1:12; go write 4/1:1; ");
}

TEST(ProgramDocument, WhenABodyIsRungs_ThenContactsBoxesAndCoilsAreThere) {
  using namespace graphic;
  Rung rung;
  rung.comment = "latch";
  rung.condition = all(
      {any({contact("start"), contact("run")}), contact("stop", true), compare("n", CompareOp::Less, "3")});
  rung.coils = {{CoilKind::Set, "run"}};
  Block timer;
  timer.type = "TON";
  timer.instance = "t";
  timer.power_input = "IN";
  timer.inputs = {{"PT", "T#1s"}};
  timer.outputs = {{"Q", "late"}};
  rung.blocks = {timer};
  Sheet sheet{"PROGRAM", "main"};
  sheet.body = LadderProgram{{rung}, {}};
  const json read = json::parse(program_document({sheet}))["sheets"][0];
  const json& block = read["blocks"][0];
  EXPECT_EQ(read["language"], "LD");
  EXPECT_EQ(block["condition"]["of"][0]["kind"], "any");
  EXPECT_EQ(block["condition"]["of"][1], json({{"kind", "contact"}, {"name", "stop"}, {"negated", true}}));
  EXPECT_EQ(block["condition"]["of"][2]["text"], "n < 3");
  EXPECT_EQ(block["boxes"][0]["power"], "IN");
  EXPECT_EQ(block["coils"][0], json({{"kind", "set"}, {"name", "run"}}));
  EXPECT_EQ(
      uses_of(read),
      "start read 0/0:0; run read 0/0:0; stop read 0/0:0; t call 0/0:0; late write 0/0:0; run write 0/0:0; ");
}

TEST(ProgramDocument, WhenABytesOfASourceAreNoUtf8_ThenTheyAreReplaced) {
  EXPECT_NO_THROW(
      document_of("PROGRAM main (* \xff\xfe *) VAR x : INT; END_VAR x := 1; (* \xc3 *) END_PROGRAM"));
}

TEST(ProgramDocument, WhenTheCompilerIsAskedForIt_ThenTheContainerHasItAndIsOtherwiseTheSame) {
  driver::CompileInput input = input_of("PROGRAM main VAR x : INT; END_VAR x := x + 1; END_PROGRAM");
  const auto bare = driver::compile(input);
  input.document = true;
  const auto full = driver::compile(input);
  ASSERT_TRUE(bare && full);
  EXPECT_EQ(reader::document_text(bare->container), "");
  EXPECT_EQ(reader::document_text(full->container), program_document(driver::sheets_of(input).value()));
  EXPECT_EQ(writer::without_document(full->container), bare->container);
  EXPECT_TRUE(reader::LoadedProgram::load(full->container, "full"));
}

TEST(ProgramDocument, WhenSourcesLieElsewhere_ThenTheContainerIsTheSame) {
  const auto compiled_in = [](const std::string& folder) {
    driver::CompileInput input;
    input.texts.push_back({folder + "/a/t.st", "PROGRAM main VAR x : INT; END_VAR x := x + 1; END_PROGRAM"});
    input.folder = folder;
    input.document = true;
    return driver::compile(input)->container;
  };
  EXPECT_EQ(compiled_in("/home/one"), compiled_in("/srv/two"));
}

}  // namespace
}  // namespace stepwright::print
