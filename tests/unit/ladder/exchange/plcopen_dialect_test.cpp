// Files of other systems: what their dialect lets them hold, and the standard does not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ladder/exchange/duration.h"
#include "ladder/exchange/plcopen_reader.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const source::Dialect& dialect(const char* name) {
  return *source::find_dialect(name);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("there is no " + what);
  return text.replace(at, what.size(), by);
}

// One program with an ST body.
std::string project_with(const std::string& variables, const std::string& statements) {
  return editor_project(
      editor_program(variables, "<ST><xhtml:p xmlns:xhtml=\"http://www.w3.org/1999/xhtml\"><![CDATA[" +
                                    statements + "]]></xhtml:p></ST>"));
}

std::string plain() {
  return project_with(bools("a"), "a := TRUE;");
}

std::string first_hint(const std::string& text) {
  const auto project = read_plcopen("plc.xml", text);
  if (project) return "no error";
  return project.error().front().hint;
}

TEST(PlcopenDialect, WhenATaskIsExported_ThenItsDurationAndTypeAreUnderstood) {
  std::string text = replaced(plain(), "T#20ms", "PT0.05S");
  text = replaced(text, "typeName=\"main\"", "typeName=\"\"");
  text = replaced(text, "name=\"run\"", "name=\"main\"");
  const auto project = read_plcopen("plc.xml", text, dialect("codesys"));
  ASSERT_TRUE(project) << to_string(project.error());
  EXPECT_EQ(project->tasks.at(0).interval_us, 50'000);
  EXPECT_EQ(project->instances.at(0).program, "main");
  const auto strict = read_plcopen("plc.xml", text);
  ASSERT_FALSE(strict);
  ASSERT_EQ(strict.error().size(), 2u);
  for (const result::Diagnostic& each : strict.error())
    EXPECT_THAT(each.hint, HasSubstr("--dialect codesys"));
}

TEST(PlcopenDialect, WhenADurationIsOfXml_ThenItIsCounted) {
  EXPECT_EQ(xsd_duration_us("PT0.05S"), 50'000);
  EXPECT_EQ(xsd_duration_us("PT1M30S"), 90'000'000);
  EXPECT_EQ(xsd_duration_us("P1DT1H"), 25 * 3'600'000'000LL);
  for (const char* wrong : {"", "P", "PT", "P1M", "PT1S1M", "T#5s", "PT5", "0.05S", "-PT1S"})
    EXPECT_EQ(xsd_duration_us(wrong), std::nullopt) << wrong;
}

TEST(PlcopenDialect, WhenAnIntervalIsAClock_ThenItIsThatOfAnOldFile) {
  EXPECT_EQ(clock_duration_us("00:00:00.100000"), 100'000);
  EXPECT_EQ(clock_duration_us("01:02:03"), 3'723'000'000);
  for (const char* wrong : {"", "00:01", "1:2:3:4", "T#5s", "a:b:c", "::"})
    EXPECT_EQ(clock_duration_us(wrong), std::nullopt) << wrong;
  const std::string text = replaced(plain(), "T#20ms", "00:00:00.100000");
  const auto project = read_plcopen("plc.xml", text, dialect("matiec"));
  ASSERT_TRUE(project) << to_string(project.error());
  EXPECT_EQ(project->tasks.at(0).interval_us, 100'000);
  EXPECT_THAT(first_hint(text), HasSubstr("--dialect matiec"));
}

TEST(PlcopenDialect, WhenOneOfSeveralConfigurationsRuns_ThenItIsTaken) {
  const std::string empty = "<configuration name=\"device\"><resource name=\"r\"></resource></configuration>";
  const std::string text = replaced(plain(), "<configurations>", "<configurations>" + empty);
  const auto project = read_plcopen("plc.xml", text, dialect("codesys"));
  ASSERT_TRUE(project) << to_string(project.error());
  EXPECT_EQ(project->instances.size(), 1u);
  EXPECT_THAT(first_hint(text), HasSubstr("--dialect codesys"));
}

TEST(PlcopenDialect, WhenTheFileIsOlderThanVersion2_ThenItsAttributesAreUnderstood) {
  const std::string text = replaced(plain(), "typeName=\"main\"", "type=\"main\"");
  const auto project = read_plcopen("plc.xml", text, dialect("matiec"));
  ASSERT_TRUE(project) << to_string(project.error());
  EXPECT_EQ(project->instances.at(0).program, "main");
  EXPECT_THAT(first_hint(text), HasSubstr("--dialect matiec"));
}

TEST(PlcopenDialect, WhenATypeIsNobodys_ThenNoDialectIsNamed) {
  const auto project = read_plcopen(
      "plc.xml",
      project_with("<variable name=\"n\"><type><derived name=\"Robot_Arm\"/></type></variable>" + bools("a"),
                   "a := TRUE;"));
  ASSERT_TRUE(project) << to_string(project.error());
  driver::CompileInput input;
  input.projects = {&*project};
  const auto output = driver::compile(input);
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().front().code, "E0203");
  EXPECT_THAT(output.error().front().hint, Not(HasSubstr("--dialect")));
}

TEST(PlcopenDialect, WhenALoggerIsNamed_ThenItsLevelIsKnown) {
  const auto project = read_plcopen(
      "plc.xml",
      project_with("<variable name=\"log\"><type><derived name=\"LOGGER\"/></type></variable>" + bools("a"),
                   "log(TRIG := a, MSG := 'x', LEVEL := LOGLEVEL#WARNING); a := TRUE;"));
  ASSERT_TRUE(project) << to_string(project.error());
  driver::CompileInput input;
  input.projects = {&*project};
  input.dialect = &dialect("matiec");
  support::CompiledProgram program(input);
  EXPECT_FALSE(program.scan().trap);
  EXPECT_EQ(program.get("run.a"), 1);
}

TEST(PlcopenDialect, WhenTypesOfTheEditorAreNamed_ThenTheyAreKnownAndBlocksDoNothing) {
  const auto project = read_plcopen(
      "plc.xml", project_with("<variable name=\"n\"><type><derived name=\"HMI_INT\"/></type></variable>"
                              "<variable name=\"p\"><type><derived name=\"python_eval\"/></type></variable>" +
                                  bools("done"),
                              "n := n + 2; p(TRIG := TRUE, CODE := 'x', ACK => done);"));
  ASSERT_TRUE(project) << to_string(project.error());
  driver::CompileInput input;
  input.projects = {&*project};
  const auto strict = driver::compile(input);
  ASSERT_FALSE(strict);
  EXPECT_THAT(strict.error().front().hint, HasSubstr("--dialect matiec"));
  input.dialect = &dialect("matiec");
  support::CompiledProgram program(input);
  EXPECT_FALSE(program.scan().trap);
  EXPECT_EQ(program.get("run.n"), 2);
  EXPECT_EQ(program.get("run.done"), 0);
}

}  // namespace
}  // namespace stepwright::exchange
