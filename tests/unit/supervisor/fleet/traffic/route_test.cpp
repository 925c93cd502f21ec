#include "supervisor/fleet/traffic/route.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "supervisor/fleet/traffic/traffic.h"
#include "tests/support/fleet_traffic/traffic_invariants.h"
#include "tests/unit/supervisor/fleet/traffic/small_floor.h"

namespace stepwright::fleet {
namespace {

Route planned(SmallFloor& floor, std::uint32_t station) {
  const std::vector<Waypoint> stops = {SmallFloor::stop(SmallFloor::station(station), "goal", 7000),
                                       {floor.planner().home(0), {}}};
  return floor.planner().plan(0, floor.planner().home(0), stops).value();
}

TEST(Route, WhenItIsMade_ThenAVehicleThatMayNotGoOnHasLeftAllPolygonsButTheOneItIsIn) {
  SmallFloor floor(1);
  for (std::uint32_t station = 0; station < 4; ++station) {
    const Route route = planned(floor, station);
    std::uint32_t alone = 0;
    for (std::uint32_t k = 2; k < route.polygons(); ++k) {
      ASSERT_GE(route.needed_m[k], route.needed_m[k - 1]);
      if (route.needed_m[k] == route.needed_m[k - 1]) continue;
      ++alone;
      EXPECT_GE(route.needed_m[k], route.left_m[k - 2] + kHalt_m - 1e-9) << k;
      EXPECT_GE(route.left_m[k - 1], std::min(route.needed_m[k], route.end_m())) << k;
    }
    EXPECT_GT(alone, 10U);
  }
}

TEST(Route, WhenPolygonsChange_ThenTheOutlineIsInsideUntilTheNextOneIsNeeded) {
  SmallFloor floor(1);
  const Route route = planned(floor, 2);
  const auto& polygons = route.mission.grown.envelope.polygons;
  for (const geometry::PathPose& at : route.mission.path) {
    const std::uint32_t k = polygon_at(route, 0, at.arc_m);
    EXPECT_TRUE(polygons[k].area.contains(footprint_at(at.pose, route.mission.model.footprint()), 1e-6))
        << at.arc_m;
  }
}

TEST(Pace, WhenAVehicleStands_ThenTimeGoesOnAndTheWayDoesNot) {
  SmallFloor floor(1);
  const Route route = planned(floor, 0);
  const double stop_m = route.mission.stops.front().arc_m;
  const double before_s = route.pace.time_s(stop_m);
  EXPECT_NEAR(route.pace.time_s(stop_m, true) - before_s, 7.0, 1e-9);
  EXPECT_NEAR(route.pace.arc_m(before_s + 3.0), stop_m, 1e-9);
  for (double arc_m = 0.0; arc_m < route.end_m(); arc_m += 0.7) {
    EXPECT_NEAR(route.pace.arc_m(route.pace.time_s(arc_m)), arc_m, 1e-6);
  }
  // No faster than a vehicle drives.
  EXPECT_GT(route.pace.time_s(route.end_m()), route.end_m() / 1.5 + 7.0);
}

TEST(Route, WhenAnotherWayBeginsOnIt_ThenWhatIsBeforeStaysAndTheRestIsTheNewWay) {
  SmallFloor floor(1);
  const Route old = planned(floor, 1);
  std::size_t branch = old.mission.path.size() / 4;
  while (!on_lattice(old.mission.path[branch].pose, 0.2)) ++branch;
  const geometry::PathPose at = old.mission.path[branch];
  const std::vector<Waypoint> stops = {{floor.planner().home(0), {}}};
  const Route home = floor.planner().plan(0, at.pose, stops).value();
  const auto made = splice(old, 0, branch, home);
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->end_m(), at.arc_m + home.end_m() - home.mission.path.front().arc_m, 1e-9);
  EXPECT_NEAR(made->pace.time_s(at.arc_m), old.pace.time_s(at.arc_m), 1e-6);
  for (std::size_t k = 1; k < made->mission.path.size(); ++k) {
    const double step_m =
        geometry::distance(made->mission.path[k].pose.position(), made->mission.path[k - 1].pose.position());
    ASSERT_LT(step_m, 0.06) << k;
    ASSERT_NEAR(made->mission.path[k].arc_m - made->mission.path[k - 1].arc_m, step_m, 1e-3) << k;
  }
  EXPECT_FALSE(splice(old, old.polygons() - 1, branch, home));  // that place has been left
}

// Along the x axis from one place to another, in polygons that hold the vehicle from and to these places.
Route straight(double from_m, double to_m, const std::vector<std::pair<double, double>>& held) {
  constexpr double kStep_m = 0.1;
  constexpr double kAround_m = 0.05;
  VehicleMission mission;
  const auto steps = static_cast<std::size_t>(std::lround((to_m - from_m) / kStep_m));
  for (std::size_t k = 0; k <= steps; ++k) {
    const double x_m = from_m + kStep_m * static_cast<double>(k);
    mission.path.push_back({{x_m, 0.0, 0.0}, x_m, geometry::Travel::Forward});
  }
  const geometry::Footprint outline = mission.model.footprint();
  const double side_m = outline.half_width_m + kAround_m;
  for (const auto& [begin_m, end_m] : held) {
    const double low_m = begin_m - outline.rear_m - kAround_m, high_m = end_m + outline.front_m + kAround_m;
    const std::array<geometry::Point, 4> corners = {
        geometry::Point{low_m, -side_m}, {high_m, -side_m}, {high_m, side_m}, {low_m, side_m}};
    const auto pose_at = [&](double x_m) {
      return static_cast<std::size_t>(std::lround((x_m - from_m) / kStep_m));
    };
    Visit visit;
    visit.first_pose = pose_at(begin_m);
    visit.last_pose = pose_at(end_m);
    visit.entry_m = begin_m;
    visit.exit_m = end_m;
    mission.grown.envelope.polygons.push_back({*geometry::ConvexPolygon::hull(corners), {}, {}});
    mission.grown.visits.push_back(visit);
  }
  std::vector<double> driving_s = driving_times_s(mission.path, {});
  return make_route(std::move(mission), std::move(driving_s)).value();
}

// It used to be permitted the new way's first polygons long before it could leave the old one: two vehicles
// that did so waited for each other.
TEST(Route, WhenTheOldPolygonHoldsTheVehicleFartherThanNewOnes_ThenItIsNeverInTwoWhereItWaits) {
  const Route old = straight(0.0, 20.0, {{0.0, 4.0}, {2.0, 14.0}, {13.0, 20.0}});
  const Route on = straight(5.0, 24.0, {{5.0, 7.0}, {6.0, 9.5}, {9.0, 11.5}, {11.0, 16.0}, {15.0, 24.0}});
  const auto made = splice(old, 0, 50, on);
  ASSERT_TRUE(made) << result::to_string(made.error());
  EXPECT_EQ(support::waits_in_two_polygons(*made, 0), "");
  // The old one holds it up to 14 m: the three new ones before that are none of its way.
  ASSERT_EQ(made->polygons(), 4U);
  EXPECT_NEAR(made->needed_m[2], 14.0, 1e-9);
  EXPECT_NEAR(made->needed_m[3], 16.0, 1e-9);
}

// Nobody comes after who stays for ever: the last polygon is the small one around the end also then.
TEST(Route, WhenTheOldPolygonHoldsTheVehicleUpToTheEnd_ThenItRestsInItsLastOneAllTheSame) {
  const Route old = straight(0.0, 20.0, {{0.0, 4.0}, {2.0, 20.0}});
  const auto made = splice(old, 0, 50, straight(5.0, 12.0, {{5.0, 8.0}, {7.0, 11.0}, {11.0, 12.0}}));
  ASSERT_TRUE(made) << result::to_string(made.error());
  EXPECT_EQ(support::waits_in_two_polygons(*made, 0), "");
  ASSERT_EQ(made->polygons(), 3U);
  EXPECT_NEAR(made->mission.grown.visits.back().entry_m, 11.0, 1e-9);
  EXPECT_NEAR(made->left_m[1], 12.0, 1e-9);
}

TEST(Traffic, WhenAVehicleRestsALittleBeforeTheEnd_ThenItIsInItsLastPolygonAlone) {
  std::vector<Route> routes;
  routes.push_back(straight(0.0, 8.0, {{0.0, 7.9}, {6.0, 8.0}}));
  auto traffic = Traffic::create(std::move(routes), {}, std::chrono::milliseconds(0));
  ASSERT_TRUE(traffic) << result::to_string(traffic.error());
  for (const double arc_m : {3.0, 6.0, 7.9}) {
    traffic->progress(0, {.arc_m = arc_m, .speed_m_s = 0.1}, std::chrono::seconds(30));
    EXPECT_FALSE(traffic->rests(0));
    EXPECT_EQ(traffic->first(0), 0U);
  }
  traffic->progress(0, {.arc_m = 7.95}, std::chrono::seconds(40));
  EXPECT_TRUE(traffic->rests(0));
  EXPECT_EQ(traffic->first(0), 1U);
}

TEST(Route, WhenTimesAreMissing_ThenItIsRefused) {
  SmallFloor floor(1);
  VehicleMission mission = planned(floor, 0).mission;
  EXPECT_EQ(make_route(mission, {0.0, 1.0}).error().front().code, "F1001");
}

}  // namespace
}  // namespace stepwright::fleet
