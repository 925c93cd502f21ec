// `stepwright explain` knows every code that a source names.

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "tests/unit/programs/compile/compile_program.h"

namespace stepwright::compile_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using ExplainCommand = CompileProgram;

// Every "P0101" in the sources of a folder.
void collect(const fs::path& folder, std::set<std::string>& codes) {
  const std::regex quoted("\"([A-Z][0-9]{4})\"");
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cpp" && extension != ".h") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    for (std::sregex_iterator at(text.begin(), text.end(), quoted), end; at != end; ++at)
      codes.insert((*at)[1]);
  }
}

TEST_F(ExplainCommand, WhenACodeStandsInASource_ThenItIsKnown) {
  std::set<std::string> used;
  for (const char* folder :
       {"ladder", "runtime", "supervisor", "plant_models", "cell", "programs", "hmi_web"})
    collect(fs::path(STEPWRIGHT_SOURCE_DIR) / folder, used);
  ASSERT_GT(used.size(), 300u);
  used.erase("T0000");  // a timer of an Omron controller
  ASSERT_EQ(run("explain"), 0) << errors;
  std::set<std::string> known;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) known.insert(line.substr(0, 5));
  for (const std::string& each : used) EXPECT_TRUE(known.contains(each)) << each << " is explained nowhere";
}

TEST_F(ExplainCommand, WhenTheCodeHasAPage_ThenThePageIsShown) {
  ASSERT_EQ(run("explain e0301"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("# E0301: "));
  ASSERT_EQ(run("explain R0401"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("# R0401: division by zero"));
}

TEST_F(ExplainCommand, WhenTheCodeStandsInATable_ThenItsRowsAreShown) {
  ASSERT_EQ(run("explain p0103"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("P0101 to P0105: unknown type, predicate, function, object, variable"));
  EXPECT_THAT(output, HasSubstr("pddl_language.md"));
  ASSERT_EQ(run("explain F0202"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("values that contradict each other"));
  ASSERT_EQ(run("explain C0304"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("overlap"));
}

TEST_F(ExplainCommand, WhenThereIsNoSuchCode_ThenTheNearestIsNamed) {
  EXPECT_EQ(run("explain E0391"), 1);
  EXPECT_THAT(errors, HasSubstr("hint: did you mean 'E0301'?"));
}

}  // namespace
}  // namespace stepwright::compile_test
