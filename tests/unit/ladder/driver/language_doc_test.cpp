// ladder/doc/language.md: every test that the page names exists.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = STEPWRIGHT_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::set<std::string> language_programs() {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests/st/programs"))
    if (entry.path().extension() == ".st") names.insert(entry.path().filename().string());
  return names;
}

std::string unit_tests() {
  std::string text;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests/unit/ladder"))
    if (entry.path().extension() == ".cpp") text += read(entry.path());
  for (const auto& entry : fs::directory_iterator(kRoot / "tests/st"))
    if (entry.path().extension() == ".cpp") text += read(entry.path());
  return text;
}

TEST(LanguagePage, Rows_WhenTheyNameTests_ThenTheTestsExist) {
  const std::string tests = unit_tests();
  const std::set<std::string> programs = language_programs();
  std::istringstream page(read(kRoot / "ladder/doc/language.md"));
  const std::regex quoted("`([^`]+)`");
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    const bool heading = line.rfind("| choice", 0) == 0 || line.rfind("| limit", 0) == 0;
    if (line.rfind("| ", 0) != 0 || heading) continue;
    ++rows;
    const std::string last = line.substr(line.rfind("| ", line.size() - 3));
    int named = 0;
    for (std::sregex_iterator at(last.begin(), last.end(), quoted), end; at != end; ++at, ++named) {
      const std::string name = (*at)[1];
      const bool program = name.size() > 3 && name.substr(name.size() - 3) == ".st";
      EXPECT_TRUE(program ? programs.count(name) == 1 : tests.find(name) != std::string::npos) << name;
    }
    EXPECT_GT(named, 0) << line;
  }
  EXPECT_GT(rows, 30);
}

}  // namespace
