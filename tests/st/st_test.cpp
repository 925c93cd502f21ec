// One test for every program in tests/st/programs and its folders; library/pid.st is the test "library_pid".

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/st/check_program.h"

namespace {

namespace fs = std::filesystem;
namespace st_test = stepwright::st_test;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> programs() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(STEPWRIGHT_SOURCE_DIR "/tests/st/programs"))
    if (entry.path().extension() == ".st") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

class StProgram : public testing::TestWithParam<fs::path> {};

TEST_P(StProgram, Language_WhenProgramRuns_ThenEveryCheckHolds) {
  const std::string text = read(GetParam());
  const auto directives = st_test::directives_of(text);
  const auto checks = std::count_if(directives.begin(), directives.end(), [](const st_test::Directive& each) {
    return each.kind != st_test::DirectiveKind::Set;
  });
  EXPECT_GT(checks, 0) << "the program checks nothing";
  for (const std::string& failure : st_test::run_checks(GetParam().filename().string(), text))
    ADD_FAILURE() << failure;
}

INSTANTIATE_TEST_SUITE_P(Programs, StProgram, testing::ValuesIn(programs()), [](const auto& each) {
  const fs::path folder = each.param.parent_path().filename();
  const std::string prefix = folder == "programs" ? "" : folder.string() + "_";
  return prefix + each.param.stem().string();
});

// The driver itself can fail: a wrong expectation is reported with its line.
TEST(CheckProgram, Checks_WhenAValueIsWrong_ThenTheLineIsReported) {
  const auto failures = st_test::run_checks(
      "wrong.st",
      "PROGRAM main\nVAR x : INT; END_VAR\nx := 4; (* CHECK scan 1: main.x = 5 *)\nEND_PROGRAM\n");
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0], "wrong.st:3: main.x is 4, not 5");
}

}  // namespace
