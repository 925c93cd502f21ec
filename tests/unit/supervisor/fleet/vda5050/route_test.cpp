#include "supervisor/fleet/vda5050/route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/vda5050/made_missions.h"

namespace stepwright::fleet::vda5050 {
namespace {

using geometry::Pose;
using support::MadeMission;

VehicleMission curved() {
  return MadeMission("v1", {10, 20, 0})
      .drive(8.0)
      .stop(StopKind::PickUp, "rack", "load")
      .drive(8.0, 0.2)
      .drive(4.0, 0.1, geometry::Travel::Reverse)
      .drive(9.0)
      .stop(StopKind::SetDown, "dock", "load")
      .mission();
}

// Wherever within the deviation the vehicle stands, its outline is in the polygon.
void expect_inside(const VehicleMission& mission, const RouteNode& node, std::uint32_t polygon) {
  const auto& area = mission.grown.envelope.polygons[polygon].area;
  const Pose at = mission.path[node.pose].pose;
  for (int k = 0; k < 16; ++k) {
    const double way = 2.0 * std::numbers::pi * k / 16.0;
    for (const double turn : {-node.deviation_rad, 0.0, node.deviation_rad}) {
      const Pose off{at.x_m + node.deviation_m * std::cos(way), at.y_m + node.deviation_m * std::sin(way),
                     at.heading_rad + turn};
      EXPECT_TRUE(area.contains(geometry::footprint_at(off, mission.model.footprint()), 1e-6))
          << "pose " << node.pose << ", polygon " << polygon;
    }
  }
}

void expect_sound(const VehicleMission& mission, const Route& route, std::size_t from) {
  ASSERT_EQ(route.nodes.front().pose, from);
  ASSERT_EQ(route.nodes.back().pose + 1, mission.path.size());
  EXPECT_EQ(route.nodes.back().polygon + 1, mission.grown.envelope.polygons.size());
  for (std::size_t k = 1; k < route.nodes.size(); ++k) {
    const RouteNode& before = route.nodes[k - 1];
    const RouteNode& node = route.nodes[k];
    ASSERT_LT(before.pose, node.pose);
    ASSERT_LE(before.polygon, node.polygon);
    expect_inside(mission, node, before.polygon);
    if (k + 1 < route.nodes.size()) expect_inside(mission, node, node.polygon);
    const auto& area = mission.grown.envelope.polygons[before.polygon].area;
    for (std::size_t pose = before.pose; pose <= node.pose; ++pose) {
      EXPECT_TRUE(
          area.contains(geometry::footprint_at(mission.path[pose].pose, mission.model.footprint()), 1e-9))
          << "pose " << pose;
      if (pose > before.pose + 1) {
        EXPECT_EQ(mission.path[pose].travel, mission.path[pose - 1].travel) << pose;
      }
    }
  }
}

TEST(Route, Nodes_WhenAMissionCurvesAndReverses_ThenTheyKeepTheVehicleInItsPolygons) {
  const VehicleMission mission = curved();
  const Route route = route_of(mission, {});
  ASSERT_NO_FATAL_FAILURE(expect_sound(mission, route, 0));
  EXPECT_GT(mission.grown.envelope.polygons.size(), 4u);
  std::size_t stops = 0;
  for (const RouteNode& node : route.nodes) stops += node.stops.size();
  EXPECT_EQ(stops, 2u);
  // Vehicles may round a hand-over off: there is room on an empty floor.
  EXPECT_TRUE(std::ranges::any_of(route.nodes,
                                  [](const RouteNode& n) { return n.stops.empty() && n.deviation_m > 0.1; }));
}

TEST(Route, Nodes_WhenMissionsAreRandom_ThenTheyKeepVehiclesInTheirPolygons) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const VehicleMission& mission : support::random_plan(3, seed).missions) {
      ASSERT_NO_FATAL_FAILURE(expect_sound(mission, route_of(mission, {}), 0)) << seed;
    }
  }
}

TEST(Route, Nodes_WhenItBeginsInTheMiddle_ThenThatPoseIsTheFirstNodeAndTheRestFollows) {
  const VehicleMission mission = curved();
  for (const std::size_t from : {1u, 40u, 81u, 163u}) {
    ASSERT_NO_FATAL_FAILURE(expect_sound(mission, route_of(mission, {}, from), from));
  }
}

TEST(Route, Nodes_WhenThePathIsOnePose_ThenOneNode) {
  const VehicleMission mission = MadeMission("v1", {20, 20, 1}).stop(StopKind::PickUp, "rack").mission();
  const Route route = route_of(mission, {});
  ASSERT_EQ(route.nodes.size(), 1u);
  EXPECT_EQ(route.nodes[0].stops.size(), 1u);
}

TEST(Thinned, Poses_WhenLeftOut_ThenTheyAreNearTheChordAndStraightLinesHaveTwo) {
  const VehicleMission mission = curved();
  EXPECT_EQ(thinned(mission.path, 0, 80, 0.002).size(), 2u);
  const auto kept = thinned(mission.path, 80, 160, 0.002);
  EXPECT_LT(kept.size(), 60u);
  EXPECT_EQ(kept.front().pose, mission.path[80].pose);
  EXPECT_EQ(kept.back().pose, mission.path[160].pose);
  for (std::size_t pose = 80; pose <= 160; ++pose) {
    double nearest = 1e9;
    for (std::size_t k = 1; k < kept.size(); ++k) {
      const geometry::Point a = kept[k - 1].pose.position(), along = kept[k].pose.position() - a;
      const geometry::Point p = mission.path[pose].pose.position();
      const double part = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
      nearest = std::min(nearest, geometry::distance(p, a + part * along));
    }
    EXPECT_LE(nearest, 0.002 + 1e-9) << pose;
  }
}

TEST(Room, Outline_WhenItLeavesThePolygon_ThenNegative) {
  const std::vector<geometry::Point> corners{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const auto square = geometry::ConvexPolygon::hull(corners);
  ASSERT_TRUE(square.has_value());
  const geometry::Footprint box{.front_m = 2, .rear_m = 1, .half_width_m = 1};
  EXPECT_NEAR(room_m(*square, {5, 5, 0}, box), 3.0, 1e-12);
  EXPECT_NEAR(room_m(*square, {9, 5, 0}, box), -1.0, 1e-12);
}

}  // namespace
}  // namespace stepwright::fleet::vda5050
