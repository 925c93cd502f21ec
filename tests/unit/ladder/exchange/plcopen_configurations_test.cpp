// Files of several devices: which configuration is read, and what of the others is left out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "ladder/exchange/plcopen_reader.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string program(const std::string& name, const std::string& external) {
  return "<pou name=\"" + name + "\" pouType=\"program\"><interface><externalVars><variable name=\"" +
         external + "\"><type><INT/></type></variable></externalVars></interface><body><ST><xhtml:p " +
         "xmlns:xhtml=\"http://www.w3.org/1999/xhtml\">" + external + " := " + external +
         " + 1;</xhtml:p></ST></body></pou>";
}

// A device with a global of its own.
std::string device(const std::string& name, const std::string& global, const std::string& runs) {
  std::string task;
  if (!runs.empty())
    task = "<task name=\"t\" priority=\"0\" interval=\"T#20ms\"><pouInstance name=\"run\" typeName=\"" +
           runs + "\"/></task>";
  return "<configuration name=\"" + name + "\"><resource name=\"r\">" + task +
         "</resource><globalVars><variable name=\"" + global +
         "\"><type><INT/></type></variable></globalVars></configuration>";
}

// Mixer runs mix, Packer runs pack, and both have counters that the other has not.
std::string plant(const std::string& more = "") {
  std::string text = editor_project(program("mix", "mixed") + program("pack", "packed"));
  const std::string open = "<configurations>";
  const std::size_t begin = text.find(open);
  const std::size_t end = text.find("</configurations>");
  if (begin == std::string::npos || end == std::string::npos) throw std::runtime_error("no configurations");
  const std::string devices = device("Mixer", "mixed", "mix") + device("Packer", "packed", "pack") + more;
  return text.replace(begin + open.size(), end - begin - open.size(), devices);
}

std::vector<std::string> programs_of(const graphic::Project& project) {
  std::vector<std::string> names;
  for (const graphic::Pou& each : project.pous) names.push_back(each.name);
  return names;
}

result::Result<graphic::Project> read(const std::string& text, const char* dialect,
                                      const std::string& configuration = {}) {
  return read_plcopen("plant.xml", text, *source::find_dialect(dialect), configuration);
}

TEST(PlcopenConfigurations, WhenSeveralRunPrograms_ThenTheErrorNamesThemOnce) {
  for (const char* dialect : {"standard", "matiec", "codesys"}) {
    const auto project = read(plant(device("Terminal", "shown", "")), dialect);
    ASSERT_FALSE(project);
    ASSERT_EQ(project.error().size(), 1U) << to_string(project.error());
    const result::Diagnostic& error = project.error().front();
    EXPECT_EQ(error.code, "E0804");
    EXPECT_GT(error.where.line, 0U);
    EXPECT_THAT(error.message, HasSubstr("'Mixer'"));
    EXPECT_THAT(error.message, HasSubstr("'Packer'"));
    EXPECT_THAT(error.hint, HasSubstr("--configuration NAME"));
    EXPECT_THAT(error.hint, Not(HasSubstr("--dialect")));
  }
}

TEST(PlcopenConfigurations, WhenOneIsChosen_ThenItsProgramsRunAndThoseOfOthersAreLeftOut) {
  for (const char* dialect : {"standard", "codesys"}) {
    for (const std::string name : {"Packer", "PACKER"}) {
      const auto project = read(plant(), dialect, name);
      ASSERT_TRUE(project) << to_string(project.error());
      EXPECT_EQ(project->configuration, "Packer");
      EXPECT_THAT(programs_of(*project), ElementsAre("pack"));
      ASSERT_EQ(project->instances.size(), 1U);
      EXPECT_EQ(project->instances[0].program, "pack");
      ASSERT_EQ(project->globals.size(), 1U);
      EXPECT_EQ(project->globals[0].name, "packed");
      driver::CompileInput input;
      input.projects = {&*project};
      const auto output = driver::compile(input);
      EXPECT_TRUE(output) << to_string(output.error());
    }
  }
}

TEST(PlcopenConfigurations, WhenTwoDevicesRunTheSameProgram_ThenItStays) {
  const auto project = read(plant(device("Spare", "packed", "pack")), "standard", "Spare");
  ASSERT_TRUE(project) << to_string(project.error());
  EXPECT_EQ(project->configuration, "Spare");
  EXPECT_THAT(programs_of(*project), ElementsAre("pack"));
}

TEST(PlcopenConfigurations, WhenTheChosenOneIsNotThere_ThenTheErrorNamesThoseThatAre) {
  const auto project = read(plant(), "standard", "Press");
  ASSERT_FALSE(project);
  ASSERT_EQ(project.error().size(), 1U);
  EXPECT_THAT(project.error()[0].message, HasSubstr("'Press'"));
  EXPECT_THAT(project.error()[0].hint, HasSubstr("'Mixer' and 'Packer'"));
}

TEST(PlcopenConfigurations, WhenTwoHaveTheChosenName_ThenNoneIsTaken) {
  EXPECT_FALSE(read(plant(device("packer", "packed", "pack")), "standard", "Packer"));
}

// A library has none, and is read with the file that has some.
TEST(PlcopenConfigurations, WhenAFileHasNone_ThenTheChoiceIsOfOtherFiles) {
  std::string text = editor_project(program("mix", "mixed"));
  const std::size_t begin = text.find("<configurations>");
  const std::string close = "</configurations>";
  const std::size_t end = text.find(close) + close.size();
  const auto project = read(text.replace(begin, end - begin, "<configurations/>"), "standard", "Packer");
  ASSERT_TRUE(project) << to_string(project.error());
  EXPECT_THAT(programs_of(*project), ElementsAre("mix"));
}

}  // namespace
}  // namespace stepwright::exchange
