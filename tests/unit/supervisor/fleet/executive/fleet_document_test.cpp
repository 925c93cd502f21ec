// What of a plan goes into the document: less than there is, and the same to whoever draws it.

#include "supervisor/fleet/executive/fleet_document.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "supervisor/fleet/executive/telling_poses.h"
#include "supervisor/fleet/schedule/sections.h"
#include "tests/unit/supervisor/fleet/executive/small_hall.h"

namespace stepwright::fleet {
namespace {

using nlohmann::json;

FleetOutcome planned() {
  SmallHall hall;
  FleetLedger ledger(hall.planning().problem());
  EXPECT_TRUE(ledger.order("box", "dock B", "dock A", 1));  // ways that cross
  auto outcome = hall.planning().plan(ledger, {.rest = {.starts = hall.planning().first_starts()}});
  EXPECT_TRUE(outcome);
  return *std::move(outcome);
}

bool inside(const json& rings, geometry::Point p) {
  int turns = 0;
  for (const json& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const geometry::Point a{ring[k][0], ring[k][1]};
      const json& next = ring[(k + 1) % ring.size()];
      const geometry::Point b{next[0], next[1]};
      if (a.y_m <= p.y_m && b.y_m > p.y_m && cross(b - a, p - a) > 0) ++turns;
      if (a.y_m > p.y_m && b.y_m <= p.y_m && cross(b - a, p - a) < 0) --turns;
    }
  }
  return turns > 0;
}

TEST(TellingPoses, WhenPosesAreLeftOut_ThenTheyLieOnTheChordsOfTheOthers) {
  const FleetOutcome outcome = planned();
  std::size_t all = 0, kept = 0;
  for (const VehicleMission& mission : outcome.prepared.answer.plan.missions) {
    const auto told = telling_poses(mission);
    all += mission.path.size();
    kept += told.size();
    ASSERT_EQ(told.front(), 0u);
    ASSERT_EQ(told.back(), mission.path.size() - 1);
    for (const Visit& visit : mission.grown.visits) {
      EXPECT_TRUE(std::ranges::binary_search(told, visit.first_pose));
      EXPECT_TRUE(std::ranges::binary_search(told, visit.last_pose));
    }
    for (const Stop& stop : mission.stops) EXPECT_TRUE(std::ranges::binary_search(told, stop.pose));
    for (std::size_t n = 1; n < told.size(); ++n) {
      const geometry::Point from = mission.path[told[n - 1]].pose.position();
      const geometry::Point along = mission.path[told[n]].pose.position() - from;
      for (std::size_t k = told[n - 1] + 1; k < told[n]; ++k) {
        const geometry::Point at = mission.path[k].pose.position() - from;
        EXPECT_LT(std::abs(cross(along, at)) / std::hypot(along.x_m, along.y_m), 0.0051);
        EXPECT_EQ(mission.path[k].travel, mission.path[k + 1].travel);
      }
    }
  }
  EXPECT_LT(5 * kept, all);
}

TEST(PlanDocument, WhenSectionsAreDrawn_ThenTheirOutlinesHoldWhatBothVehiclesCover) {
  const FleetOutcome outcome = planned();
  const FleetPlan& plan = outcome.prepared.answer.plan;
  const json document = json::parse(plan_document(outcome.prepared, outcome.rest.problem));
  const auto envelopes = envelopes_of(plan);
  const Sections sections = merge_sections(overlapping_pairs(envelopes), envelopes);
  ASSERT_GT(sections.sections.size(), 0u);
  ASSERT_EQ(document["sections"].size(), sections.sections.size());
  std::size_t corners = 0;
  for (std::size_t k = 0; k < sections.sections.size(); ++k) {
    const json& rings = document["sections"][k]["corners_m"];
    for (const json& ring : rings) corners += ring.size();
    for (const SpatialPair& pair : sections.of(sections.sections[k])) {
      const auto both = intersection(envelopes[pair.a.vehicle].polygons[pair.a.polygon].area,
                                     envelopes[pair.b.vehicle].polygons[pair.b.polygon].area);
      // A sliver thinner than the tolerance may be missing.
      if (!both || both->area_m2() < 0.05) continue;
      EXPECT_TRUE(inside(rings, both->centroid())) << k;
    }
  }
  EXPECT_LT(corners, 2 * sections.pairs.size());  // pair by pair it were four and more of each
  EXPECT_FALSE(document.contains("conflicts"));
}

}  // namespace
}  // namespace stepwright::fleet
