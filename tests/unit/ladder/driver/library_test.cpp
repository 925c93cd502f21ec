#include "ladder/driver/library.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "ladder/driver/compile.h"
#include "ladder/source/name_table.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "tests/support/compiled_program.h"

namespace {

using namespace stepwright;

result::Result<driver::CompileOutput> compile(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"t.st", text});
  return driver::compile(input);
}

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// A program that names everything, so that every declaration is parsed and analysed.
std::string program_that_names_all() {
  std::string structure = "TYPE everything : STRUCT ";
  for (const driver::LibraryDeclaration& each : driver::library_declarations())
    structure += std::string(each.name) + " : BOOL; ";
  return structure + "END_STRUCT; END_TYPE\nPROGRAM main\nVAR x : everything; END_VAR\nEND_PROGRAM\n";
}

TEST(Library, Declarations_WhenAllAreCompiled_ThenNothingIsReported) {
  const auto output = compile(program_that_names_all());
  ASSERT_TRUE(output) << to_string(output.error());
  EXPECT_TRUE(output->warnings.empty()) << to_string(output->warnings);
}

// Through two functions of the library; the user sees the own call, and where the library noticed.
TEST(Library, Trap_WhenAFunctionOfTheLibraryNoticesIt_ThenTheCallIsThePlace) {
  driver::CompileInput input;
  input.texts.push_back({"t.st",
                         "PROGRAM main\nVAR m : INT := 13; d : DT; END_VAR\n"
                         "  d := CONCAT_DT(2024,\n    m, 1, 0, 0, 0, 0);\nEND_PROGRAM\n"});
  support::CompiledProgram program(input);
  const bytecode::Trap trap = program.scan().trap;
  ASSERT_TRUE(trap.in_library());
  EXPECT_EQ(trap.caller, 0u);
  const result::Diagnostic described = reader::describe(program.loaded().program(), trap);
  EXPECT_EQ(described.where.file, "t.st");
  EXPECT_EQ(described.where.line, 3u);
  EXPECT_EQ(described.where.column, 8u);
  EXPECT_NE(described.message.find(" in CONCAT_DATE (library/dates.st:"), std::string::npos)
      << described.message;
  EXPECT_NE(described.message.find("called here"), std::string::npos) << described.message;
}

TEST(Library, Declarations_WhenListed_ThenNamesAreUnique) {
  std::set<std::string> names;
  for (const auto& each : driver::library_declarations()) {
    EXPECT_TRUE(names.insert(source::upper(each.name)).second) << each.name;
    EXPECT_LT(each.begin, each.end);
  }
  EXPECT_GT(names.size(), 50u);
}

TEST(Library, Document_WhenComparedWithTheDeclarations_ThenEachHasItsRow) {
  const std::string document = read(std::string(STEPWRIGHT_SOURCE_DIR) + "/ladder/doc/standard_library.md");
  for (const auto& each : driver::library_declarations())
    EXPECT_NE(document.find("`" + std::string(each.name) + "`"), std::string::npos) << each.name;
}

TEST(Library, Container_WhenABlockIsUsed_ThenOnlyItAndItsPartsAreInside) {
  const auto plain = compile("PROGRAM main\nVAR x : INT; END_VAR\nx := x + 1;\nEND_PROGRAM\n");
  const auto with_block = compile(
      "PROGRAM main\nVAR x : INT; d : DEBOUNCE; END_VAR\nx := x + 1;\nd(IN := x > 3);\nEND_PROGRAM\n");
  ASSERT_TRUE(plain && with_block);
  const auto names = [](const driver::CompileOutput& output) {
    std::set<std::string> list;
    const auto loaded = reader::LoadedProgram::load(output.container, "t");
    const bytecode::ContainerView& view = loaded->program().container();
    for (std::uint32_t i = 0; i < view.count<bytecode::Section::Functions>(); ++i) {
      const auto name = view.string(view.record<bytecode::Section::Functions>(i).name);
      list.insert(std::string(name.begin(), name.end()));
    }
    return list;
  };
  EXPECT_EQ(names(*plain), (std::set<std::string>{"main"}));
  EXPECT_EQ(names(*with_block), (std::set<std::string>{"main", "DEBOUNCE", "TON"}));
}

TEST(Library, Compile_WhenAUserDeclaresTheNameOfABlock_ThenTheUsersIsMeant) {
  const auto output = compile(
      "FUNCTION_BLOCK pid\nVAR_OUTPUT mine : INT := 7; END_VAR\nEND_FUNCTION_BLOCK\n"
      "PROGRAM main\nVAR c : PID; x : INT; END_VAR\nc();\nx := c.mine;\nEND_PROGRAM\n");
  EXPECT_TRUE(output) << to_string(output.error());
}

TEST(Library, Compile_WhenAUserDeclaresAStandardBlock_ThenItIsReported) {
  const auto output =
      compile("TYPE ton : INT; END_TYPE\nPROGRAM main\nVAR c : INT; END_VAR\nc := 1;\nEND_PROGRAM\n");
  ASSERT_FALSE(output);
  ASSERT_EQ(output.error().size(), 1u) << to_string(output.error());
  EXPECT_EQ(output.error()[0].code, "E0202");
  EXPECT_EQ(output.error()[0].where.line, 1u);
}

TEST(Library, Compile_WhenAVariableHasTheNameOfABlock_ThenItIsAVariable) {
  const auto output =
      compile("PROGRAM main\nVAR ramp, average : INT; END_VAR\nramp := average + 1;\nEND_PROGRAM\n");
  EXPECT_TRUE(output) << to_string(output.error());
}

}  // namespace
