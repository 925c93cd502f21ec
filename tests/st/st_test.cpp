// The programs of tests/st/programs, one GoogleTest case each; ctest runs a folder at a time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "tests/st/check_program.h"

namespace {

namespace st_test = stepwright::st_test;
using st_test::Directive;
using st_test::DirectiveKind;

const std::string kRoot = STEPWRIGHT_SOURCE_DIR "/tests/st/programs";

class StProgram : public testing::TestWithParam<std::string> {};

TEST_P(StProgram, Language_WhenProgramRuns_ThenEveryCheckHolds) {
  const std::string text = st_test::read_file(kRoot + "/" + GetParam());
  const auto directives = st_test::directives_of(text);
  const bool checks = std::ranges::any_of(directives, [](const Directive& each) {
    return each.kind != DirectiveKind::Set && each.kind != DirectiveKind::Requirement;
  });
  EXPECT_TRUE(checks) << "the program checks nothing";
  for (const std::string& failure : st_test::run_checks(GetParam(), text)) ADD_FAILURE() << failure;
}

std::string test_name(const testing::TestParamInfo<std::string>& each) {
  std::string name = each.param.substr(0, each.param.size() - 3);
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Programs, StProgram, testing::ValuesIn(st_test::programs_below(kRoot)), test_name);

}  // namespace
