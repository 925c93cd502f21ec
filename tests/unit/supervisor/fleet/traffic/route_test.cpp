#include "supervisor/fleet/traffic/route.h"

#include <gtest/gtest.h>

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

TEST(Route, WhenTimesAreMissing_ThenItIsRefused) {
  SmallFloor floor(1);
  VehicleMission mission = planned(floor, 0).mission;
  EXPECT_EQ(make_route(mission, {0.0, 1.0}).error().front().code, "F1001");
}

}  // namespace
}  // namespace stepwright::fleet
