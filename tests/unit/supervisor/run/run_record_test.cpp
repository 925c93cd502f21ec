#include "supervisor/run/run_record.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::run {
namespace {

using nlohmann::json;

TEST(RunRecord, WhenAMissionHasDetails_ThenTheyStandBesideTheOtherPartsAndAreReadBack) {
  RunRecord record;
  record.cell = "yard";
  record.message = "the cranes work";
  record.episodes.emplace_back();
  record.details["cranes"] = R"({"moved":3})";
  record.details["yard"] = R"(["north","south"])";
  const json document = json::parse(to_json(record));
  EXPECT_EQ(document["cranes"]["moved"], 3);
  EXPECT_EQ(document["yard"][1], "south");
  const auto read = record_from_json(to_json(record), "journal.json");
  ASSERT_TRUE(read) << result::to_string(read.error());
  EXPECT_EQ(*read, record);
}

TEST(RunRecord, WhenADetailIsNamedLikeAPartOfTheRecord_ThenThePartStays) {
  RunRecord record;
  record.message = "of the run";
  record.details["message"] = R"("of the mission")";
  EXPECT_EQ(json::parse(to_json(record))["message"], "of the run");
}

}  // namespace
}  // namespace stepwright::run
