#include "supervisor/fleet/traffic/route_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "tests/unit/supervisor/fleet/traffic/small_floor.h"

namespace stepwright::fleet {
namespace {

std::vector<geometry::Pose> goals_of(SmallFloor& floor, std::uint32_t vehicles) {
  std::vector<geometry::Pose> goals;
  for (std::uint32_t k = 0; k < 4; ++k) goals.push_back(SmallFloor::station(k));
  for (std::uint32_t v = 0; v < vehicles; ++v) goals.push_back(floor.planner().home(v));
  return goals;
}

result::Result<Route> round_trip(RoutePlanner& planner, std::uint32_t vehicle, std::uint32_t station) {
  const std::vector<Waypoint> stops = {SmallFloor::stop(SmallFloor::station(station), "goal"),
                                       SmallFloor::stop(planner.home(vehicle), "home")};
  return planner.plan(vehicle, planner.home(vehicle), stops);
}

TEST(RoutePlanner, WhenCostsOfWaysAreKnown_ThenWaysAreAsGoodAndBlockedPlacesAreStillAvoided) {
  constexpr std::uint32_t kVehicles = 4;
  SmallFloor plain(kVehicles), prepared(kVehicles);
  auto goals = goals_of(prepared, kVehicles);
  goals.push_back({-50.0, 0.0, 0.0});  // off the floor
  prepared.planner().prepare(goals, 2);
  const auto wall = geometry::ConvexPolygon::hull(
      std::vector<geometry::Point>{{20.0, 6.0}, {22.0, 6.0}, {22.0, 14.0}, {20.0, 14.0}});
  for (const bool blocked : {false, true}) {
    if (blocked) plain.planner().block(*wall);
    if (blocked) prepared.planner().block(*wall);
    for (std::uint32_t v = 0; v < kVehicles; ++v) {
      for (std::uint32_t station = 0; station < 4; ++station) {
        const auto before = round_trip(plain.planner(), v, station);
        const auto made = round_trip(prepared.planner(), v, station);
        ASSERT_EQ(made.has_value(), before.has_value());
        if (!made) continue;
        EXPECT_LT(made->pace.time_s(made->end_m()), 1.1 * before->pace.time_s(before->end_m()));
        const auto& polygons = made->mission.grown.envelope.polygons;
        EXPECT_TRUE(!blocked || std::ranges::none_of(polygons, [&](const EnvelopePolygon& polygon) {
          return overlaps(polygon.area, *wall);
        }));
      }
    }
  }
}

geometry::ConvexPolygon rectangle(geometry::Point low, geometry::Point high) {
  return *geometry::ConvexPolygon::hull(
      std::vector<geometry::Point>{low, {high.x_m, low.y_m}, high, {low.x_m, high.y_m}});
}

// Each question used to look at all of the floor, half a second of it in a hall of 100 m.
TEST(RoutePlanner, WhenBlockedPlacesEncloseAGoal_ThenOnlyTheFirstSearchIsInVainAndOthersFindTheirWays) {
  constexpr std::uint32_t kVehicles = 4;
  for (const bool prepared : {false, true}) {
    SmallFloor floor(kVehicles);
    RoutePlanner& planner = floor.planner();
    if (prepared) planner.prepare(goals_of(floor, kVehicles), 2);
    // The aisle below, on both sides of its stations, but for a gap that is a little too narrow.
    const std::uint32_t left = planner.block(rectangle({9.5, 6.2}, {10.5, 12.3}));
    planner.block(rectangle({33.5, 6.2}, {34.5, 12.3}));
    for (int again = 0; again < 5; ++again) {
      for (const std::uint32_t v : {1U, 3U}) {
        const auto way = round_trip(planner, v, 0);
        ASSERT_FALSE(way.has_value());
        EXPECT_EQ(way.error().front().code, "F0305");
      }
    }
    EXPECT_EQ(planner.searches_in_vain(), 1U);
    // Who is enclosed with it, and who wants to go elsewhere.
    EXPECT_TRUE(planner.plan(2, planner.home(2), std::vector{SmallFloor::stop(SmallFloor::station(1), "g")}));
    EXPECT_TRUE(
        planner.plan(2, SmallFloor::station(0), std::vector{SmallFloor::stop(SmallFloor::station(1), "g")}));
    EXPECT_TRUE(round_trip(planner, 1, 2).has_value());
    planner.unblock(left);
    EXPECT_TRUE(round_trip(planner, 1, 0).has_value());
  }
}

bool meets(const Route& route, const geometry::ConvexPolygon& area) {
  return std::ranges::any_of(route.mission.grown.envelope.polygons,
                             [&](const EnvelopePolygon& polygon) { return overlaps(polygon.area, area); });
}

// In the middle of the aisle; with the rest of it shut there is no way but through.
TEST(RoutePlanner, WhenAPlaceIsToBeAvoided_ThenOthersGoAroundItWhereTheyCanAndItsVehicleThrough) {
  SmallFloor floor(4);
  RoutePlanner& planner = floor.planner();
  const std::vector past = {SmallFloor::stop({30.0, 10.0, 0.0}, "past")};
  const geometry::Pose from{14.0, 10.0, 0.0};
  const auto place = rectangle({21.0, 9.0}, {22.0, 11.0});
  const auto straight = planner.plan(1, from, past);
  ASSERT_TRUE(straight && meets(*straight, place));
  const std::uint32_t avoided = planner.avoid(2, place);
  const auto around = planner.plan(1, from, past);
  ASSERT_TRUE(around);
  EXPECT_FALSE(meets(*around, place));
  const auto its_own = planner.plan(2, from, past);
  ASSERT_TRUE(its_own);
  EXPECT_NEAR(its_own->end_m(), straight->end_m(), 1e-9);
  planner.block(rectangle({20.0, 6.0}, {23.0, 9.0}));
  planner.block(rectangle({20.0, 11.0}, {23.0, 14.0}));
  planner.block(rectangle({20.0, 22.0}, {23.0, 30.0}));
  const auto through = planner.plan(1, from, past);
  ASSERT_TRUE(through) << result::to_string(through.error());
  EXPECT_TRUE(meets(*through, place));
  planner.unblock(avoided);
  EXPECT_FALSE(planner.meets_room(SmallFloor::station(1)));
}

TEST(RoutePlanner, WhenSeveralThreadsPlan_ThenEachGetsTheWayThatOneAloneGets) {
  constexpr std::uint32_t kVehicles = 4;
  SmallFloor alone(kVehicles), shared(kVehicles);
  alone.planner().prepare(goals_of(alone, kVehicles), 1);
  shared.planner().prepare(goals_of(shared, kVehicles), 3);
  std::vector<std::vector<double>> ends_m(3);
  {
    std::vector<std::jthread> threads;
    for (auto& ends : ends_m) {
      threads.emplace_back([&] {
        for (std::uint32_t v = 0; v < kVehicles; ++v) {
          for (std::uint32_t station = 0; station < 4; ++station)
            ends.push_back(round_trip(shared.planner(), v, station)->end_m());
        }
      });
    }
  }
  std::vector<double> expected;
  for (std::uint32_t v = 0; v < kVehicles; ++v) {
    for (std::uint32_t station = 0; station < 4; ++station)
      expected.push_back(round_trip(alone.planner(), v, station)->end_m());
  }
  for (const auto& ends : ends_m) EXPECT_EQ(ends, expected);
  EXPECT_EQ(shared.planner().paths_planned(), alone.planner().paths_planned());
}

}  // namespace
}  // namespace stepwright::fleet
