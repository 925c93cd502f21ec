// What is wrong with [[monitors]], with its place.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/cell/monitors/monitored.h"

namespace stepwright::cell_monitors {
namespace {

constexpr const char* kProgram =
    "PROGRAM main VAR at_wash : BOOL; level : INT; END_VAR\nlevel := level + 1;\nEND_PROGRAM\n";

struct Case {
  std::string toml;
  std::string found;  // "line code" of the first problem
};

std::string first_of(const std::string& toml) {
  result::Diagnostics problems;
  const auto config = test::cell_of(toml, &problems);
  if (problems.empty()) {
    const auto container = test::compiled_with(config, kProgram);
    if (!container) problems = container.error();
  }
  if (problems.empty()) return "sound";
  EXPECT_EQ(problems.front().where.file, "cell.toml") << result::to_string(problems);
  return std::to_string(problems.front().where.line) + " " + problems.front().code;
}

std::string monitor(const std::string& lines) {
  return "[[monitors]]\nname = \"m\"\n" + lines;
}

TEST(WrongMonitors, WhenRead_ThenTheFirstProblemHasItsPlace) {
  const std::vector<Case> cases = {
      {monitor("formula = \"never main.at_wash\"\n"), "sound"},
      {"[[monitors]]\nname = \"2m\"\nformula = \"never a\"\n", "2 C0551"},
      {"[[monitors]]\nname = \"m__x\"\nformula = \"never a\"\n", "2 C0551"},
      {"[[monitors]]\nname = \"\"\nformula = \"never a\"\n", "2 C0551"},
      {"[[monitors]]\nname = \" \"\nformula = \"never a\"\n", "2 C0551"},
      {"[[monitors]]\nformula = \"never a\"\n", "1 C0005"},
      {monitor("formula = \"never main.at_wash\"\n") + "[[monitors]]\nname = \"M\"\nformula = \"F a\"\n",
       "5 C0552"},
      {monitor(""), "1 C0553"},
      {monitor("formula = \"never a\"\nformula_file = \"a.ltl\"\n"), "4 C0553"},
      {monitor("formula = \"\"\n"), "3 C0553"},
      {monitor("formula = \"\"\nformula_file = \"a.ltl\"\n"), "4 C0553"},
      {monitor("formula = \"never a\"\nformula_file = \"\"\n"), "4 C0553"},
      {monitor("formula = \"never a\"\non_false = [\"explode\"]\n"), "4 C0554"},
      {monitor("formula = \"never a\"\nlet = { a = \"main.level >= 2; x := 1\" }\n"), "4 C0555"},
      {monitor("formula = \"never a\"\nlet = { a = \" \" }\n"), "4 C0555"},
      {monitor("formula = 'never \"a b\"'\n"), "3 C0556"},
      {monitor("formula = \"never main.at_wash\"\nlet = { b = \"main.level > 2\" }\n"), "4 C0557"},
      {monitor("formla = \"never a\"\n"), "1 C0553"},
      {monitor("formula = \"never (a\"\n"), "3 L0002"},
      {monitor("formula = \"G F main.at_wash\"\n"), "3 L0014"},
      {monitor("formula = \"never main.at_wash for T#0s\"\n"), "3 L0008"},
      {monitor("formula = \"after a: s responds to p within T#5s\"\n"), "3 L0008"},
      {monitor("formula = \"never main.atwash\"\n"), "3 E0204"},
      {monitor("formula = \"never nothing\"\n"), "3 E0201"},
      {monitor("formula = \"never Failed\"\n"), "3 E0201"},
      {monitor("formula = \"never a\"\nlet = { a = \"State > 3\" }\n"), "4 E0201"},
      {monitor("formula = \"never a\"\nlet = { a = \"!main.at_wash\" }\n"), "sound"},
      {monitor("formula = \"never a\"\nlet = { a = \"main.level\" }\n"), "4 E0301"},
      {monitor("formula = \"never a\"\nlet = { a = \"main.level >= \" }\n"), "4 E0104"},
      {monitor("formula = \"never a\"\nlet = { a = \"other.level >= 3\" }\n"), "4 E0201"},
  };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.toml);
    EXPECT_EQ(first_of(each.toml), each.found);
  }
}

TEST(WrongMonitors, WhenAKeyIsUnknown_ThenTheHintHasAllThatAreKnown) {
  result::Diagnostics problems;
  (void)test::cell_of(monitor("formula = \"never a\"\ncolour = \"red\"\n"), &problems);
  ASSERT_EQ(problems.size(), 1u) << result::to_string(problems);
  EXPECT_EQ(problems.front().code, "C0002");
  EXPECT_EQ(problems.front().hint, "known here: formula, formula_file, let, name, on_false");
}

TEST(WrongMonitors, WhenTheFileOfAFormulaHasNoEnd_ThenRefused) {
  const auto monitors = cell_monitors(test::cell_of(monitor("formula_file = \"/dev/zero\"\n")));
  ASSERT_FALSE(monitors);
  EXPECT_EQ(monitors.error().front().code, "E0001");
  EXPECT_EQ(monitors.error().front().where.file, "/dev/zero");
}

TEST(WrongMonitors, WhenProgramsOfSeveralTasksAreRead_ThenRefused) {
  const std::string tasks =
      "PROGRAM fast VAR a : BOOL; END_VAR\na := NOT a;\nEND_PROGRAM\nCONFIGURATION c\n"
      "TASK quick(INTERVAL := T#1ms);\nTASK calm(INTERVAL := T#10ms);\nPROGRAM f1 WITH quick : fast;\n"
      "PROGRAM s1 WITH calm : fast;\nEND_CONFIGURATION\n";
  const auto container =
      test::compiled_with(test::cell_of(monitor("formula = \"f1.a precedes s1.a\"\n")), tasks);
  ASSERT_FALSE(container);
  EXPECT_EQ(container.error().front().code, "E0604");
  EXPECT_EQ(container.error().front().where.line, 3u);
}

TEST(WrongMonitors, WhenAPartOfTheFormulaIsWrong_ThenTheMessageSaysWhereInIt) {
  const auto monitors = cell_monitors(test::cell_of(monitor("formula = \"never a, (b\"\n")));
  ASSERT_FALSE(monitors);
  EXPECT_NE(monitors.error().front().message.find("(at 1:12 of the formula)"), std::string::npos)
      << result::to_string(monitors.error());
}

}  // namespace
}  // namespace stepwright::cell_monitors
