#include "cell/missions/tamp/table/tamp_table.h"

#include <gtest/gtest.h>

namespace stepwright::missions {
namespace {

struct Reading {
  std::shared_ptr<const MissionTable> table;
  result::Diagnostics problems;
};

constexpr const char* kOrder = "[[tamp.orders]]\nname = \"P1\"\ngoal = \"(in cup1 red-region)\"\n";

Reading read(const std::string& lines, const std::string& orders = kOrder) {
  const std::string text = "[tamp]\nproblem = \"orders.toml\"\n" + lines + orders;
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document);
  Reading reading;
  reading.table =
      read_tamp_table((*document)->root().table("tamp"), {STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell"});
  reading.problems = (*document)->finish();
  return reading;
}

TEST(TampTable, WhenItHasOrders_ThenTheyAreReadWithTheirPlaces) {
  const Reading reading = read("order = \"P1\"\nretries = 2\nfollowing_rad = 0.01\n");
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  const auto* table = table_as<TampTable>(reading.table);
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->orders.size(), 1u);
  EXPECT_EQ(table->orders[0].goal, "(in cup1 red-region)");
  EXPECT_EQ(table->orders[0].where.line, 8u);
  EXPECT_EQ(table->retries, 2);
  EXPECT_EQ(table->following_rad, 0.01);
  EXPECT_EQ(table->unattended(), (std::vector<std::string>{"tamp.attended=false"}));
}

TEST(TampTable, WhenSomethingIsWrong_ThenItIsToldAtItsLine) {
  const auto line = [](const Reading& reading) {
    return reading.problems.size() == 1 ? reading.problems[0].where.line : 0u;
  };
  EXPECT_EQ(line(read("order = \"P9\"\n")), 3u);
  EXPECT_EQ(line(read("time_s = 0\n")), 3u);
  EXPECT_EQ(line(read("following_rad = 0\n")), 3u);
  EXPECT_EQ(line(read("domain = \"nowhere.pddl\"\n")), 3u);
  EXPECT_EQ(line(read("", std::string(kOrder) + kOrder)), 7u) << "two of a name";
  EXPECT_EQ(line(read("", std::string(kOrder) + "[[tamp.requests]]\nat_s = 1\nrequest = \"fly\"\n")), 8u);
  EXPECT_EQ(line(read("", std::string(kOrder) + "[[tamp.requests]]\nat_s = 1\nrequest = \"goal\"\n")), 8u);
  EXPECT_EQ(read("", "").problems.size(), 1u) << "no order";
}

}  // namespace
}  // namespace stepwright::missions
