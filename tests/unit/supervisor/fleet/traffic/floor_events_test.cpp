#include "supervisor/fleet/traffic/floor_events.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/supervisor/fleet/traffic/small_floor.h"

namespace stepwright::fleet {
namespace {

geometry::ConvexPolygon box(double x, double y, double width_m, double height_m) {
  const std::array<geometry::Point, 4> corners = {
      geometry::Point{x, y}, {x + width_m, y}, {x + width_m, y + height_m}, {x, y + height_m}};
  return *geometry::ConvexPolygon::hull(corners);
}

TEST(FloorEvents, WhenAnAisleIsBlocked_ThenTheWayLeadsThroughTheOtherOne) {
  SmallFloor floor(1);
  ASSERT_TRUE(floor.send(0, 1));
  for (int k = 0; k < 12; ++k) floor.tick();
  const double before_m = floor.traffic().route(0).end_m();
  const Blockage made = floor.events().block(box(21.0, 6.0, 2.0, 8.0), floor.now());
  ASSERT_EQ(made.detours.size(), 1U);
  EXPECT_EQ(made.detours[0].kind, DetourKind::Rerouted) << result::to_string(made.detours[0].why);
  EXPECT_GT(floor.traffic().route(0).end_m(), before_m + 10.0);
  floor.changed(0);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST(FloorEvents, WhenTheGoalCannotBeReached_ThenTheVehicleGoesHomeAndGivesItUp) {
  SmallFloor floor(1);
  ASSERT_TRUE(floor.send(0, 1));
  for (int k = 0; k < 12; ++k) floor.tick();
  const Blockage made = floor.events().block(box(26.0, 6.0, 4.0, 8.0), floor.now());
  ASSERT_EQ(made.detours.size(), 1U);
  EXPECT_EQ(made.detours[0].kind, DetourKind::SentHome);
  EXPECT_EQ(made.detours[0].given_up.size(), 1U);
  EXPECT_FALSE(made.detours[0].why.empty());
  floor.changed(0);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST(FloorEvents, WhenThereIsNoWayAtAll_ThenItWaitsAndDrivesOnWhenThePlaceIsFree) {
  SmallFloor floor(1);
  ASSERT_TRUE(floor.send(0, 1));
  while (floor.traffic().arc_m(0) < 2.0) floor.tick();
  // Right across the mouth of its bay, which it is about to leave: neither on nor home.
  const Blockage made = floor.events().block(box(6.0, 9.5, 9.0, 3.0), floor.now());
  ASSERT_EQ(made.detours.size(), 1U);
  ASSERT_EQ(made.detours[0].kind, DetourKind::Waits);
  EXPECT_TRUE(floor.traffic().held(0));
  EXPECT_FALSE(floor.settle(100));
  for (const geometry::PathPose& at : floor.traffic().route(0).mission.path) {
    if (at.arc_m > floor.traffic().arc_m(0)) break;
    EXPECT_FALSE(floor.planner().meets_blocked(at.pose)) << at.arc_m;
  }
  const auto on = floor.events().unblock(made.number);
  ASSERT_EQ(on.size(), 1U);
  EXPECT_EQ(on[0].kind, DetourKind::DrivesOn);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST(FloorEvents, WhenAVehicleDies_ThenOthersDriveAroundItAndItComesBack) {
  SmallFloor floor(2);
  ASSERT_TRUE(floor.send(0, 1));
  while (floor.traffic().arc_m(0) < 18.0) floor.tick();
  const geometry::Path path = floor.traffic().route(0).mission.path;
  const auto at =
      std::ranges::lower_bound(path, floor.traffic().arc_m(0) - 1e-9, {}, &geometry::PathPose::arc_m);
  floor.events().died(0, at->pose, floor.now());
  ASSERT_TRUE(floor.traffic().removed(0));
  ASSERT_TRUE(floor.send(1, 1));
  const auto outline = footprint_at(at->pose, RouteSettings{}.vehicle.footprint());
  for (const geometry::PathPose& other : floor.traffic().route(1).mission.path)
    ASSERT_FALSE(overlaps(outline, footprint_at(other.pose, RouteSettings{}.vehicle.footprint())));
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
  const auto back = floor.events().came_back(0, floor.traffic().arc_m(0), false, floor.now());
  ASSERT_TRUE(back) << result::to_string(back.error());
  floor.changed(0);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

}  // namespace
}  // namespace stepwright::fleet
