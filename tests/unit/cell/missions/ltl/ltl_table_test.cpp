#include "cell/missions/ltl/table/ltl_table.h"

#include <gtest/gtest.h>

namespace stepwright::missions {
namespace {

struct Reading {
  std::shared_ptr<const MissionTable> table;
  result::Diagnostics problems;
};

Reading read(const std::string& lines) {
  const std::string text = "[ltl]\nproblem = \"hall.json\"\n" + lines;
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document);
  Reading reading;
  reading.table =
      read_ltl_table((*document)->root().table("ltl"), {STEPWRIGHT_SOURCE_DIR "/tests/cells/tugger"});
  reading.problems = (*document)->finish();
  return reading;
}

TEST(LtlTable, WhenThreadsAreNamed_ThenThePlannerHasThem) {
  const Reading none = read(""), one = read("threads = 1\n");
  ASSERT_TRUE(none.problems.empty() && one.problems.empty());
  EXPECT_EQ(table_as<LtlTable>(none.table)->threads, 0u) << "as many as the machine has";
  EXPECT_EQ(table_as<LtlTable>(one.table)->threads, 1u);
  const Reading many = read("threads = 3\n");
  ASSERT_EQ(many.problems.size(), 1u);
  EXPECT_EQ(many.problems[0].code, "C0004");
  EXPECT_EQ(many.problems[0].where.line, 3u);
}

}  // namespace
}  // namespace stepwright::missions
