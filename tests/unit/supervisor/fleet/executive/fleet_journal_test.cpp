#include "supervisor/fleet/executive/fleet_journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace stepwright::fleet {
namespace {

FleetJournal sample() {
  FleetJournal journal;
  journal.record.phase = run::Phase::Executing;
  journal.record.details["fleet"] = R"({"revision": 1})";
  journal.clock = {42.5, 12.5, 7};
  journal.next_request = 2;
  journal.ledger.vehicles.resize(1);
  journal.ledger.vehicles[0].aboard[3] = 2;
  journal.ledger.tasks_dropped = {true};
  journal.request.rest.starts.resize(1);
  journal.request.revision = 5;
  const std::vector<geometry::Point> corners = {{1, 1}, {3, 1}, {3, 2}, {1, 2}};
  journal.blocked.push_back({"spill", geometry::ConvexPolygon::hull(corners).value()});
  journal.epoch_s = 4.5;
  return journal;
}

TEST(FleetJournal, WhenWrittenAndRead_ThenItIsTheSameWithoutTheDocument) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "journal.json";
  ASSERT_TRUE(write_fleet_journal(file, sample()).has_value());
  const auto read = read_fleet_journal(file);
  ASSERT_TRUE(read.has_value() && read->has_value()) << result::to_string(read.error());
  EXPECT_EQ((*read)->record.phase, run::Phase::Executing);
  EXPECT_TRUE((*read)->record.details.empty());
  EXPECT_EQ((*read)->clock.now_s, 42.5);
  EXPECT_EQ((*read)->clock.incarnation, 7u);
  EXPECT_EQ((*read)->next_request, 2u);
  EXPECT_EQ((*read)->ledger.vehicles.at(0).aboard.at(3), 2u);
  EXPECT_EQ((*read)->ledger.tasks_dropped, std::vector<bool>{true});
  EXPECT_EQ((*read)->request.revision, 5u);
  EXPECT_NEAR((*read)->blocked.at(0).area.area_m2(), 2.0, 1e-12);
  EXPECT_EQ((*read)->epoch_s, 4.5);
}

TEST(FleetJournal, WhenItsPartsDoNotBelongTogetherOrItIsNone_ThenItIsRefused) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "journal.json";
  EXPECT_FALSE(read_fleet_journal(file).value().has_value()) << "there is none";
  FleetJournal journal = sample();
  journal.request.rest.starts.clear();
  ASSERT_TRUE(write_fleet_journal(file, journal).has_value());
  EXPECT_EQ(read_fleet_journal(file).error().front().code, "X0001");
  for (const char* text : {"{", "7", R"({"version": 9})", R"({"version": 1})"}) {
    std::ofstream(file) << text;
    const auto read = read_fleet_journal(file);
    ASSERT_FALSE(read.has_value()) << text;
    EXPECT_EQ(read.error().front().code, "X0001") << text;
  }
}

}  // namespace
}  // namespace stepwright::fleet
