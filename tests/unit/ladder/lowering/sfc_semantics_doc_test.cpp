// ladder/doc/sfc_semantics.md and the tests hold each other: every id of the page is cited by a test, and the
// tests cite no id that the page does not have.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = STEPWRIGHT_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::set<std::string> ids_in(const std::string& text) {
  static const std::regex kId("SFC-[A-Z](-[A-Z0-9]+)?-[0-9]+");
  std::set<std::string> ids;
  for (std::sregex_iterator at(text.begin(), text.end(), kId), end; at != end; ++at) ids.insert(at->str());
  return ids;
}

TEST(SfcSemantics, Ids_WhenPageAndTestsAreCompared_ThenEachCitesTheOther) {
  std::set<std::string> cited;
  for (const char* folder :
       {"tests/unit/ladder/lowering", "tests/unit/ladder/driver", "tests/unit/ladder/exchange",
        "tests/unit/ladder/graphic", "tests/st/programs"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.is_regular_file()) cited.merge(ids_in(read(entry.path())));
  }
  const std::set<std::string> promised = ids_in(read(kRoot / "ladder/doc/sfc_semantics.md"));
  EXPECT_GT(promised.size(), 80U);
  EXPECT_EQ(promised, cited);
}

TEST(SfcSemantics, Table_WhenQualifiersAreCounted_ThenEachHasEverySituation) {
  const std::set<std::string> promised = ids_in(read(kRoot / "ladder/doc/sfc_semantics.md"));
  for (const char* qualifier : {"N", "S", "R", "L", "D", "P", "P0", "P1", "SD", "DS", "SL"}) {
    for (int situation = 1; situation <= 7; ++situation) {
      const std::string id = std::string("SFC-Q-") + qualifier + "-" + std::to_string(situation);
      EXPECT_EQ(promised.count(id), 1U) << id;
    }
  }
}

}  // namespace
