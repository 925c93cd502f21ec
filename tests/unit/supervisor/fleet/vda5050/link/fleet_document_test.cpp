#include "supervisor/fleet/vda5050/link/fleet_document.h"

#include <gtest/gtest.h>

#include <cmath>

#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "tests/unit/supervisor/fleet/vda5050/link/made_document.h"

namespace stepwright::vda5050_link {
namespace {

using nlohmann::json;

result::Result<PlanDocument> read(const json& document) {
  return read_plan_document(document.dump(), "document", [](const std::string&) { return VehicleData{}; });
}

TEST(FleetDocument, Plan_WhenWrittenAndRead_ThenItIsTheSame) {
  const fleet::FleetPlan plan = crossing_plan();
  const auto document = read(document_of(plan, 7));
  ASSERT_TRUE(document) << result::to_string(document.error());
  EXPECT_EQ(document->program_digest, "abc");
  ASSERT_TRUE(document->fleet);
  EXPECT_EQ(document->fleet->revision, 7u);
  const fleet::FleetPlan& again = document->fleet->plan;
  ASSERT_EQ(again.missions.size(), plan.missions.size());
  EXPECT_EQ(again.schedule.precedences, plan.schedule.precedences);
  EXPECT_FALSE(again.schedule.precedences.empty());
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    const fleet::VehicleMission &was = plan.missions[v], &is = again.missions[v];
    ASSERT_EQ(is.path.size(), was.path.size());
    for (std::size_t k = 0; k < was.path.size(); ++k) {
      ASSERT_NEAR(is.path[k].pose.x_m, was.path[k].pose.x_m, 1e-4);
      ASSERT_NEAR(
          std::remainder(is.path[k].pose.heading_rad - was.path[k].pose.heading_rad, 6.283185307179586), 0.0,
          1e-4);
      ASSERT_NEAR(is.path[k].arc_m, was.path[k].arc_m, 2e-3);
      ASSERT_EQ(is.path[k].travel, was.path[k].travel) << v << " " << k;
    }
    ASSERT_EQ(is.grown.visits.size(), was.grown.visits.size());
    for (std::size_t k = 0; k < was.grown.visits.size(); ++k) {
      EXPECT_EQ(is.grown.visits[k].first_pose, was.grown.visits[k].first_pose);
      EXPECT_EQ(is.grown.visits[k].last_pose, was.grown.visits[k].last_pose);
    }
    ASSERT_EQ(is.stops.size(), was.stops.size());
    for (std::size_t s = 0; s < was.stops.size(); ++s) {
      EXPECT_EQ(is.stops[s].pose, was.stops[s].pose);
      EXPECT_EQ(is.stops[s].kind, was.stops[s].kind);
      EXPECT_EQ(is.stops[s].goal, was.stops[s].goal);
    }
  }
}

TEST(FleetDocument, Names_WhenTheyAreNoLevelOfATopic_ThenTheVariableIsTheSerialNumber) {
  const auto document = read(document_of(crossing_plan()));
  ASSERT_TRUE(document && document->fleet);
  EXPECT_EQ(document->fleet->vehicles[0].serial_number, "v1");
  EXPECT_EQ(document->fleet->vehicles[1].serial_number, "truck_2");
  EXPECT_TRUE(fleet::vda5050::FleetOrders::create(document->fleet->plan, {}));
}

TEST(FleetDocument, Cell_WhenItIsNoFleet_ThenNoPlanAndNoFault) {
  const auto document = read({{"phase", "done"}, {"program_digest", "abc"}, {"actions", json::array()}});
  ASSERT_TRUE(document);
  EXPECT_FALSE(document->fleet);
}

TEST(FleetDocument, Document_WhenItContradictsItself_ThenF0911WithThePlace) {
  const json good = document_of(crossing_plan());
  const std::pair<const char*, json> changes[] = {{"/fleet/revision", "one"},
                                                  {"/fleet/vehicles", json::array()},
                                                  {"/fleet/vehicles/0/variable", 1},
                                                  {"/fleet/vehicles/1/vehicle", "v1"},
                                                  {"/fleet/vehicles/1/vehicle", "nobody"},
                                                  {"/fleet/paths/0/poses_m_m_deg", json::array()},
                                                  {"/fleet/paths/0/poses_m_m_deg/3", {1, 2}},
                                                  {"/fleet/paths/0/poses_m_m_deg/3/0", 1e12},
                                                  {"/fleet/paths/0/length_m", 900.0},
                                                  {"/fleet/paths/1/stops/0/amount", -1},
                                                  {"/fleet/polygons/0/polygons", json::array()},
                                                  {"/fleet/polygons/0/polygons/1/corners_m", json::array()},
                                                  {"/fleet/polygons/0/polygons/1/way_m", {5.0, 1.0}},
                                                  {"/fleet/precedences/0/first/polygon", 10'000},
                                                  {"/fleet/precedences/0/second/vehicle", "nobody"}};
  for (const auto& [pointer, value] : changes) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    const auto document = read(bad);
    ASSERT_FALSE(document) << pointer;
    EXPECT_EQ(document.error().front().code, "F0911") << pointer;
    EXPECT_NE(document.error().front().message.find("/fleet"), std::string::npos) << pointer;
  }
  EXPECT_FALSE(read_plan_document("{", "document", nullptr));
}

// Whatever is left out is told, and costs nothing else.
TEST(FleetDocument, Document_WhenAMemberIsMissing_ThenItIsNamed) {
  const json good = document_of(crossing_plan());
  for (const char* key : {"revision", "vehicles", "verdict", "precedences", "paths", "polygons"}) {
    json bad = good;
    bad["fleet"].erase(key);
    const auto document = read(bad);
    ASSERT_FALSE(document) << key;
    EXPECT_NE(document.error().front().message.find(std::string("'") + key + "'"), std::string::npos);
  }
}

}  // namespace
}  // namespace stepwright::vda5050_link
