#include "supervisor/fleet/traffic/floor_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

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

// A vehicle dies across the aisle below: between it and the racks there is room to drive, but not if so much
// is kept free before and behind it as it needs to begin to drive again.
class DeadAcrossTheAisle : public testing::Test {
 protected:
  void SetUp() override {
    stop_there();
    die();
  }
  void stop_there() {
    ASSERT_TRUE(floor.send(kDead, kPlace));
    const auto at_stop = [&] {
      return floor.traffic().arc_m(kDead) >= floor.traffic().route(kDead).mission.stops[0].arc_m - 1e-6;
    };
    for (int k = 0; k < 400 && !at_stop(); ++k) floor.tick();
    ASSERT_TRUE(at_stop());
  }
  void die() { floor.events().died(kDead, kPlace, floor.now()); }
  void block_aisle_above() { floor.events().block(box(21.0, 22.0, 2.0, 8.0), floor.now()); }
  static geometry::ConvexPolygon around_dead(double along_m, double beside_m) {
    const VehicleModel model = with_margin({});
    return footprint_at(kPlace,
                        {model.front_m + along_m, model.rear_m + along_m, 0.5 * model.width_m + beside_m});
  }
  // Of what is still before it.
  bool way_meets(std::uint32_t vehicle, const geometry::ConvexPolygon& area) {
    const VehicleMission& mission = floor.traffic().route(vehicle).mission;
    return std::ranges::any_of(mission.path, [&](const geometry::PathPose& at) {
      return at.arc_m >= floor.traffic().arc_m(vehicle) &&
             overlaps(footprint_at(at.pose, mission.model.footprint()), area);
    });
  }
  bool stands_in(std::uint32_t vehicle, const geometry::ConvexPolygon& area) {
    const VehicleMission& mission = floor.traffic().route(vehicle).mission;
    const auto at = std::ranges::lower_bound(mission.path, floor.traffic().arc_m(vehicle) - 1e-9, {},
                                             &geometry::PathPose::arc_m);
    return overlaps(footprint_at(at->pose, mission.model.footprint()), area);
  }
  // Whether all that the vehicle is permitted and has not left keeps out of there; or the last of it.
  bool clear_of(std::uint32_t vehicle, const geometry::ConvexPolygon& area) {
    const auto& polygons = floor.traffic().route(vehicle).mission.grown.envelope.polygons;
    for (std::uint32_t k = floor.traffic().first(vehicle); k < floor.traffic().granted(vehicle); ++k)
      if (overlaps(polygons[k].area, area)) return false;
    return true;
  }
  bool could_wait_in(std::uint32_t vehicle, const geometry::ConvexPolygon& area) {
    const auto& polygons = floor.traffic().route(vehicle).mission.grown.envelope.polygons;
    return overlaps(polygons[floor.traffic().granted(vehicle) - 1].area, area);
  }
  // Through the room, until it has left it; false if it might ever have had to wait there.
  bool passes_in_one_go(std::uint32_t vehicle) {
    bool was_in = false;
    for (int k = 0; k < 600; ++k) {
      floor.tick();
      if (!floor.broken().empty() || could_wait_in(vehicle, room)) return false;
      was_in = was_in || stands_in(vehicle, room);
      if (was_in && clear_of(vehicle, room)) return true;
    }
    return false;
  }
  bool comes_back_within(int ticks, const std::set<std::uint32_t>& stand = {}) {
    for (int k = 0; k < ticks; ++k) {
      if (come_back()) return true;
      floor.tick(stand);
      if (!floor.broken().empty()) return false;
    }
    return false;
  }
  result::Result<std::vector<Detour>> come_back() {
    auto back = floor.events().came_back(kDead, floor.traffic().arc_m(kDead), false, floor.now());
    if (back) floor.changed(kDead);
    return back;
  }

  static constexpr std::uint32_t kDead = 2, kOther = 0;
  static constexpr geometry::Pose kPlace{22.0, 10.0, 0.5 * std::numbers::pi};
  const geometry::ConvexPolygon outline = around_dead(0.0, 0.0);
  const geometry::ConvexPolygon room = around_dead(0.75, 0.15);
  SmallFloor floor{7};
};

TEST_F(DeadAcrossTheAisle, WhenThereIsAnotherWay_ThenItsRoomIsKeptFree) {
  ASSERT_TRUE(floor.send(kOther, 1));
  EXPECT_FALSE(way_meets(kOther, room));
}

TEST_F(DeadAcrossTheAisle, WhenThereIsNoOtherWay_ThenOthersDriveThroughItsRoomAndItComesBackWhenThatIsFree) {
  block_aisle_above();
  const auto sent = floor.send(kOther, 1);
  ASSERT_TRUE(sent) << result::to_string(sent.error());
  EXPECT_TRUE(way_meets(kOther, room));
  EXPECT_FALSE(way_meets(kOther, outline));
  for (int k = 0; k < 400 && !stands_in(kOther, room); ++k) floor.tick();
  ASSERT_TRUE(stands_in(kOther, room));
  const auto refused = come_back();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "F1003");
  EXPECT_TRUE(floor.planner().meets_blocked(kPlace));
  EXPECT_TRUE(floor.traffic().removed(kDead));
  for (int k = 0; k < 400 && stands_in(kOther, room); ++k) floor.tick();
  bool back = false;
  for (int k = 0; k < 200 && !back; ++k) {
    floor.tick();
    EXPECT_EQ(floor.broken(), "");
    back = come_back().has_value();
  }
  EXPECT_TRUE(back);
  EXPECT_FALSE(floor.planner().meets_room(kPlace));
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST_F(DeadAcrossTheAisle, WhenSomebodyHasToWaitBehindItsRoom_ThenHeWaitsBeforeIt) {
  block_aisle_above();
  ASSERT_TRUE(floor.send(kOther, 1));
  while (floor.traffic().arc_m(kOther) < 12.0) floor.tick();
  ASSERT_FALSE(stands_in(kOther, room));
  // Neither back home nor on; up to the place it would stand in the room.
  const Blockage behind = floor.events().block(box(7.0, 6.0, 5.0, 3.0), floor.now());
  const Blockage beyond = floor.events().block(box(24.4, 6.0, 1.0, 8.0), floor.now());
  ASSERT_EQ(beyond.detours.size(), 1U);
  ASSERT_EQ(beyond.detours[0].kind, DetourKind::Waits);
  for (int k = 0; k < 60; ++k) floor.tick();
  EXPECT_FALSE(stands_in(kOther, room));
  EXPECT_TRUE(floor.traffic().held(kOther));
  // However long that takes: then both go on.
  floor.events().unblock(behind.number);
  floor.events().unblock(beyond.number);
  floor.changed(kOther);
  bool back = false;
  for (int k = 0; k < 400 && !back; ++k) {
    floor.tick();
    EXPECT_EQ(floor.broken(), "");
    back = come_back().has_value();
  }
  EXPECT_TRUE(back);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST_F(DeadAcrossTheAisle, WhenThereIsNoOtherWay_ThenItsRoomIsPassedInOneGo) {
  block_aisle_above();
  ASSERT_TRUE(floor.send(kOther, 1));
  EXPECT_TRUE(passes_in_one_go(kOther)) << floor.broken();
  // And back.
  EXPECT_TRUE(passes_in_one_go(kOther)) << floor.broken();
  EXPECT_TRUE(comes_back_within(200)) << floor.broken();
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

// One is past the room and stands there for as long as it likes; another one wants to go the same way.
TEST_F(DeadAcrossTheAisle, WhenSomebodyHasToWaitForAnother_ThenHeWaitsBeforeTheRoomAndItComesBackMeanwhile) {
  block_aisle_above();
  constexpr std::uint32_t kFromTheRight = 6;
  ASSERT_TRUE(floor.send(kOther, 1));
  ASSERT_TRUE(passes_in_one_go(kOther)) << floor.broken();
  for (int k = 0; k < 400 && !stands_in(kOther, room); ++k) floor.tick();
  ASSERT_TRUE(stands_in(kOther, room)) << "on its way back";
  const auto sent = floor.send(kFromTheRight, 0);
  ASSERT_TRUE(sent) << result::to_string(sent.error());
  for (int k = 0; k < 100 && !clear_of(kOther, room); ++k) floor.tick();
  for (int k = 0; k < 120; ++k) {
    floor.tick({kOther});
    ASSERT_EQ(floor.broken(), "");
    ASSERT_TRUE(clear_of(kFromTheRight, room)) << k;
  }
  EXPECT_EQ(floor.traffic().waits_for(kFromTheRight), kOther);
  EXPECT_TRUE(floor.traffic().is_before_room(kFromTheRight, kDead));
  EXPECT_FALSE(floor.traffic().held(kFromTheRight));
  const auto back = come_back();
  EXPECT_TRUE(back) << result::to_string(back.error());
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

// Else there would always be somebody in its room: each new one may get there before it has asked again.
TEST_F(DeadAcrossTheAisle, WhenItHasAskedInVain_ThenNobodyGetsANewWayThroughItsRoom) {
  block_aisle_above();
  ASSERT_TRUE(floor.send(kOther, 1));
  ASSERT_TRUE(floor.send(1, 1));
  for (int k = 0; k < 400 && !stands_in(kOther, room); ++k) floor.tick();
  ASSERT_TRUE(stands_in(kOther, room));
  EXPECT_TRUE(floor.planner().plan(3, floor.planner().home(3),
                                   std::array{SmallFloor::stop(SmallFloor::station(1), "a")}));
  ASSERT_FALSE(come_back());
  const auto refused = floor.send(3, 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code.substr(0, 3), "F03") << "no way";
  // The other two pass it twice at most, there and back.
  int passes = 0;
  bool was_in = true, back = false;
  for (int k = 0; k < 1000 && !back; ++k) {
    floor.tick();
    ASSERT_EQ(floor.broken(), "");
    const bool in = !clear_of(kOther, room) || !clear_of(1, room);
    passes += in && !was_in ? 1 : 0;
    was_in = in;
    if (k % 10 == 0) back = come_back().has_value();
    EXPECT_EQ(floor.send(3, 1).has_value(), back);
  }
  EXPECT_TRUE(back);
  EXPECT_LE(passes, 4);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST_F(DeadAcrossTheAisle, WhenAMissionWouldEndInItsRoom_ThenItIsRefusedAndAStopThereIsNot) {
  const geometry::Pose beside{24.0, 12.8, 0.0};
  ASSERT_TRUE(floor.planner().meets_room(beside));
  ASSERT_FALSE(floor.planner().meets_blocked(beside));
  const std::array ends = {SmallFloor::stop(beside, "ends")};
  const auto route = floor.planner().plan(kOther, floor.planner().home(kOther), ends);
  ASSERT_FALSE(route);
  const auto sent = floor.send(kOther, beside);
  ASSERT_TRUE(sent) << result::to_string(sent.error());
  EXPECT_TRUE(passes_in_one_go(kOther)) << floor.broken();
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

// The same without the death of the one across.
class StandsAcrossTheAisle : public DeadAcrossTheAisle {
 protected:
  void SetUp() override { stop_there(); }
};

TEST_F(StandsAcrossTheAisle, WhenAWayWasThereBeforeItDies_ThenItsRoomIsPassedInOneGoAllTheSame) {
  block_aisle_above();
  const std::uint32_t there = floor.planner().block(outline);
  ASSERT_TRUE(floor.send(kOther, 1));
  floor.planner().unblock(there);
  ASSERT_TRUE(way_meets(kOther, room));
  for (int k = 0; k < 4; ++k) floor.tick({kDead});
  die();
  ASSERT_FALSE(floor.traffic().held(kOther));
  EXPECT_TRUE(way_meets(kOther, room));
  EXPECT_TRUE(passes_in_one_go(kOther)) << floor.broken();
  EXPECT_TRUE(comes_back_within(400)) << floor.broken();
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

// It may have to drive back, and waits for who stands behind it; they for it as long as the place is blocked.
TEST(FloorEvents, WhenSomebodyIsHeld_ThenOthersTakeWaysAroundHimUntilHeDrivesOn) {
  SmallFloor floor(3);
  ASSERT_TRUE(floor.send(0, 1));
  while (floor.traffic().arc_m(0) < 12.0) floor.tick();
  // Neither home nor to its stop.
  const Blockage home = floor.events().block(box(7.0, 6.0, 5.0, 3.0), floor.now());
  const Blockage stop = floor.events().block(box(29.4, 9.0, 1.0, 2.0), floor.now());
  ASSERT_TRUE(floor.traffic().held(0));
  for (int k = 0; k < 60; ++k) floor.tick();
  const geometry::Path& own = floor.traffic().route(0).mission.path;
  const auto here =
      std::ranges::lower_bound(own, floor.traffic().arc_m(0) - 1e-9, {}, &geometry::PathPose::arc_m)->pose;
  floor.events().retry(floor.now());
  EXPECT_TRUE(floor.planner().meets_room(here));
  floor.events().unblock(home.number);
  floor.events().unblock(stop.number);
  floor.changed(0);
  EXPECT_FALSE(floor.traffic().held(0));
  EXPECT_FALSE(floor.planner().meets_room(here));
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

// The one that dies stands beside the way of the other one, whose outline passes through its room alone.
TEST(FloorEvents, WhenAVehicleDiesBesideAWay_ThenThatWayLeadsAroundItsRoom) {
  SmallFloor floor(2);
  ASSERT_TRUE(floor.send(0, 1));
  while (floor.traffic().arc_m(0) < 6.0) floor.tick();
  const geometry::Pose place{22.0, 7.0, 0.5 * std::numbers::pi};
  const auto meets_room = [&] {
    const VehicleMission& mission = floor.traffic().route(0).mission;
    const auto room = footprint_at(place, {1.7 + 0.75, 2.5 + 0.75, 0.8 + 0.15});
    return std::ranges::any_of(mission.path, [&](const geometry::PathPose& at) {
      return overlaps(footprint_at(at.pose, mission.model.footprint()), room);
    });
  };
  ASSERT_TRUE(meets_room());
  const auto detours = floor.events().died(1, place, floor.now());
  ASSERT_EQ(detours.size(), 1U);
  EXPECT_EQ(detours[0].kind, DetourKind::Rerouted);
  EXPECT_FALSE(meets_room());
  floor.changed(0);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

// Its brake needs a way to hold it, and it tells no more where it is.
TEST(FloorEvents, WhenAVehicleDiesAtSpeed_ThenNobodyDrivesWhereItMayHaveComeToRest) {
  SmallFloor floor(2);
  ASSERT_TRUE(floor.send(0, 1));
  while (floor.traffic().arc_m(0) < 20.0) floor.tick();
  ASSERT_GT(floor.traffic().speed_m_s(0), 0.5);
  const geometry::Path path = floor.traffic().route(0).mission.path;
  const auto at =
      std::ranges::lower_bound(path, floor.traffic().arc_m(0) - 1e-9, {}, &geometry::PathPose::arc_m);
  const bool reverse = at->travel == geometry::Travel::Reverse;
  floor.events().died(0, at->pose, floor.now());
  const VehicleModel model = with_margin({});
  const auto pose_ahead = [&](double by_m) {  // of another vehicle that stands behind or before it
    const double away_m = model.front_m + model.rear_m + by_m;
    const double signed_m = reverse ? -away_m : away_m;
    return geometry::Pose{at->pose.x_m + signed_m * std::cos(at->pose.heading_rad),
                          at->pose.y_m + signed_m * std::sin(at->pose.heading_rad), at->pose.heading_rad};
  };
  EXPECT_TRUE(floor.planner().meets_blocked(pose_ahead(0.3)));
  EXPECT_FALSE(floor.planner().meets_blocked(pose_ahead(0.5)));
  EXPECT_TRUE(floor.planner().meets_room(pose_ahead(0.5)));
}

}  // namespace
}  // namespace stepwright::fleet
