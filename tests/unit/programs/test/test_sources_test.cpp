// The sources below tests/st/tests: a comment (* FAILS text *) stands on the line at which a test fails and
// gives a part of what is said there; every other test passes. On both engines.

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>
#include <vector>

#include "tests/unit/programs/test/test_command.h"

namespace stepwright::test_program {
namespace {

namespace fs = std::filesystem;

struct Expectation {
  std::size_t line = 0;
  std::string text;
};

std::vector<Expectation> expectations_of(const fs::path& file) {
  std::vector<Expectation> list;
  std::ifstream in(file);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    constexpr std::string_view kMark = "(* FAILS ";
    for (std::size_t at = line.find(kMark); at != std::string::npos; at = line.find(kMark, at + 1)) {
      const std::size_t begin = at + kMark.size();
      list.push_back({number, line.substr(begin, line.find(" *)", begin) - begin)});
    }
  }
  return list;
}

std::vector<std::string> source_names() {
  std::vector<std::string> names;
  for (const auto& each : fs::directory_iterator(STEPWRIGHT_SOURCE_DIR "/tests/st/tests"))
    names.push_back(each.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class TestSources : public TestCommand,
                    public testing::WithParamInterface<std::tuple<std::string, const char*>> {};

TEST_P(TestSources, Run_WhenATestIsMeantToFail_ThenItFailsThereAndAllOthersPass) {
  const auto& [name, engine] = GetParam();
  const fs::path file = fs::path(STEPWRIGHT_SOURCE_DIR) / "tests/st/tests" / (name + ".st");
  std::vector<Expectation> expected = expectations_of(file);
  ASSERT_EQ(run(file.string() + " --engine " + engine), expected.empty() ? 0 : 1) << errors;
  const nlohmann::json json = report();
  ASSERT_FALSE(json["tests"].empty());
  for (const auto& test : json["tests"]) {
    if (test["passed"]) continue;
    const auto& failure = test["failure"];
    const std::string said = failure["text"];
    const auto found = std::ranges::find_if(expected, [&](const Expectation& each) {
      return each.line == failure["line"].get<std::size_t>() && said.find(each.text) != std::string::npos;
    });
    EXPECT_NE(found, expected.end()) << test["name"] << " at line " << failure["line"] << ": " << said;
    if (found != expected.end()) expected.erase(found);
    EXPECT_EQ(failure["file"], file.string());
    EXPECT_GT(failure["column"].get<int>(), 0);
  }
  for (const Expectation& each : expected)
    ADD_FAILURE() << "no test fails at line " << each.line << ": " << each.text;
}

INSTANTIATE_TEST_SUITE_P(Sources, TestSources,
                         testing::Combine(testing::ValuesIn(source_names()), testing::Values("native", "vm")),
                         [](const auto& each) {
                           return std::get<0>(each.param) + "_" + std::get<1>(each.param);
                         });

}  // namespace
}  // namespace stepwright::test_program
