// Plans for drawn floors, compiled by the ordinary driver, run on both engines in lock-step with the
// simulated vehicles. The judge looks at nothing but where these truly are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/fleet_program/fleet_rig.h"
#include "tests/support/fleet_program/planned_fleet.h"
#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::fleet {
namespace {

double planned_s(const FleetPlan& plan, std::size_t vehicle) {
  return 1e-3 * static_cast<double>(plan.schedule.earliest[vehicle].back().exit.count());
}

// Which vehicles wait for this one somewhere, directly or through others.
std::vector<bool> waits_for(const FleetPlan& plan, std::uint32_t vehicle) {
  std::vector<bool> waits(plan.missions.size(), false);
  for (std::size_t round = 0; round < waits.size(); ++round) {
    for (const Precedence& wait : plan.schedule.precedences) {
      if (wait.first.vehicle == vehicle || waits[wait.first.vehicle]) waits[wait.second.vehicle] = true;
    }
  }
  waits[vehicle] = false;
  return waits;
}

void expect_safe(const FleetRig& rig) {
  EXPECT_EQ(rig.overlaps, 0U) << rig.state();
  EXPECT_EQ(rig.wall_hits, 0U) << rig.state();
  EXPECT_EQ(rig.truth("contacts"), 0.0) << rig.state();
  EXPECT_LT(rig.most_overrun_m, 0.1) << rig.state();
}

TEST(FleetProgramRun, WhenSevenVehiclesDriveInTheMine_ThenAllArriveInTimeAndNobodyMeetsAnybody) {
  const support::DrawnFloor mine = support::draw_mine(1);
  const FleetPlan plan = plan_mine(7);
  FleetRig rig(plan, {.grid = &mine.grid});
  rig.run(300.0);
  EXPECT_TRUE(rig.all_arrived()) << rig.state();
  expect_safe(rig);
  EXPECT_TRUE(rig.engines_agree);
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    EXPECT_NEAR(rig.arrival_s[v], planned_s(plan, v), 3.0 + 0.05 * planned_s(plan, v)) << rig.name(v);
    EXPECT_LT(rig.most_deviation_m[v], 0.12) << rig.name(v);
    const auto goal = plan.missions[v].path.back().pose;
    EXPECT_LT(geometry::distance(rig.pose(v).position(), goal.position()), 0.12) << rig.name(v);
  }
}

TEST(FleetProgramRun, WhenFewerVehiclesDrive_ThenAllArrive) {
  for (const std::size_t vehicles : {2U, 3U, 4U, 6U}) {
    const FleetPlan plan = vehicles < 5 ? plan_warehouse(vehicles) : plan_mine(vehicles);
    FleetRig rig(plan, {.seed = vehicles, .native = false});
    rig.run(300.0);
    EXPECT_TRUE(rig.all_arrived()) << rig.state();
    expect_safe(rig);
  }
}

TEST(FleetProgramRun, WhenAVehicleIsLate_ThenOthersWaitForIt) {
  const support::DrawnFloor floor = support::draw_warehouse(1);
  const FleetPlan plan = plan_warehouse(5);
  FleetRig rig(plan, {.grid = &floor.grid});
  const std::vector<bool> waits = waits_for(plan, 0);
  ASSERT_GE(std::ranges::count(waits, true), 1) << "nobody has to wait for the first vehicle";
  rig.run(5.0);
  rig.fault("weak_v1", 0.02);
  rig.run(60.0);
  rig.fault("weak_v1", 1.0);
  rig.run(400.0);
  EXPECT_TRUE(rig.all_arrived()) << rig.state();
  expect_safe(rig);
  EXPECT_TRUE(rig.engines_agree);
  double latest_s = 0.0;
  for (std::size_t v = 1; v < plan.missions.size(); ++v) {
    if (waits[v]) latest_s = std::max(latest_s, rig.arrival_s[v] - planned_s(plan, v));
    if (waits[v]) continue;
    EXPECT_NEAR(rig.arrival_s[v], planned_s(plan, v), 3.0 + 0.05 * planned_s(plan, v)) << rig.name(v);
  }
  EXPECT_GT(latest_s, 10.0) << rig.state();
}

// The same run without what the charts ask of other vehicles: then the judge has something to say.
TEST(FleetProgramRun, WhenInterlocksAreTakenOut_ThenOutlinesOverlap) {
  const FleetPlan plan = plan_warehouse(5);
  FleetRig rig(plan, {.native = false, .interlocks = false});
  ASSERT_GT(rig.program().figures.interlocks, 0U);
  rig.run(5.0);
  rig.fault("weak_v1", 0.02);
  rig.run(60.0);
  rig.fault("weak_v1", 1.0);
  rig.run(120.0);
  EXPECT_GT(rig.overlaps, 0U) << rig.state();
}

TEST(FleetProgramRun, WhenAVehicleDies_ThenItIsLocatedAndOthersStopBeforeWhatItHasNotLeft) {
  const support::DrawnFloor floor = support::draw_warehouse(1);
  const FleetPlan plan = plan_warehouse(5);
  FleetRig rig(plan, {.grid = &floor.grid});
  const std::vector<bool> waits = waits_for(plan, 0);
  rig.run(12.0);
  const double arc = rig.of("Arc", 0);
  rig.fault("dead_v1", 1);
  for (int k = 0; k < 20; ++k) rig.scan();
  EXPECT_EQ(rig.of("ErrorID", 0), 27.0) << rig.state();  // does not answer
  EXPECT_NEAR(rig.of("ErrorArc", 0), arc, 0.6);
  EXPECT_NEAR(rig.of("ErrorX", 0), rig.pose(0).x_m, 0.6);
  // A reset does not bring it back, and what it does not answer is no progress.
  const double areas = rig.global("areas", 0);
  rig.set("fleet_reset", true);
  for (int k = 0; k < 20; ++k) rig.scan();
  rig.set("fleet_reset", false);
  EXPECT_EQ(rig.of("ErrorID", 0), 21.0) << rig.state();
  EXPECT_NEAR(rig.of("Arc", 0), arc, 0.6);
  EXPECT_EQ(rig.global("areas", 0), areas);
  rig.run(160.0);
  expect_safe(rig);
  EXPECT_TRUE(rig.engines_agree);
  std::size_t held = 0;
  for (std::size_t v = 1; v < plan.missions.size(); ++v) {
    held += rig.arrived(v) ? 0 : 1;
    if (waits[v]) continue;
    EXPECT_TRUE(rig.arrived(v)) << rig.state();
  }
  EXPECT_GE(held, 1U) << rig.state();
  for (std::size_t v = 1; v < plan.missions.size(); ++v) {
    EXPECT_TRUE(rig.arrived(v) || rig.of("Standing", v) == 1.0) << rig.state();
  }
}

TEST(FleetProgramRun, WhenTheEmergencyStopIsPressed_ThenAllStopAndGoOnAfterAReset) {
  const FleetPlan plan = plan_warehouse(5);
  FleetRig rig(plan, {});
  rig.run(20.0);
  rig.fault("press_estop", 1);
  for (int k = 0; k < 100; ++k) rig.scan();
  std::vector<geometry::Pose> stood;
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    EXPECT_EQ(rig.of("ErrorID", v), 24.0);
    EXPECT_EQ(rig.global("enable", v), 0);
    stood.push_back(rig.pose(v));
  }
  // Released alone, it starts nothing.
  rig.fault("press_estop", 0);
  for (int k = 0; k < 100; ++k) rig.scan();
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    EXPECT_LT(geometry::distance(rig.pose(v).position(), stood[v].position()), 0.01);
  }
  rig.set("fleet_reset", true);
  rig.scan();
  rig.set("fleet_reset", false);
  rig.run(200.0);
  EXPECT_TRUE(rig.all_arrived()) << rig.state();
  expect_safe(rig);
  EXPECT_TRUE(rig.engines_agree);
}

TEST(FleetProgramRun, WhenNavigationFreezesOrTheSteeringSticks_ThenTheVehicleStopsAndIsLocated) {
  const FleetPlan plan = plan_warehouse(3);
  FleetRig rig(plan, {.native = false});
  rig.run(8.0);
  ASSERT_GT(std::abs(rig.of("Speed", 0)), 0.1) << rig.state();
  rig.fault("frozen_pose_v1", 1);
  rig.fault("stuck_steering_v2", 1);
  rig.run(60.0);
  EXPECT_EQ(rig.of("ErrorID", 0), 26.0) << rig.state();
  EXPECT_TRUE(rig.of("ErrorID", 1) == 28.0 || rig.of("ErrorID", 1) == 21.0) << rig.state();
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_EQ(rig.global("enable", v), 0) << rig.state();
    EXPECT_NEAR(rig.of("ErrorX", v), rig.pose(v).x_m, 1.0);
    EXPECT_NEAR(rig.of("ErrorY", v), rig.pose(v).y_m, 1.0);
  }
  expect_safe(rig);
}

TEST(FleetProgramRun, WhenAPalletIsToBeCarried_ThenItIsPickedUpAndSetDownWhereItBelongs) {
  // Forward onto the pallet, back, and forward to where it is to stand.
  const auto path = MadePath({10, 10, 0})
                        .drive(6.0)
                        .drive(5.0, 0.0, geometry::Travel::Reverse)
                        .drive(6.0, 0.2)
                        .drive(3.0)
                        .path();
  FleetPlan plan = plan_alone(path);
  Stop pick{.kind = StopKind::PickUp, .location = "a", .goal = "pallet", .amount = 1, .aboard = 1, .pose = 0};
  pick.arc_m = 6.0;
  pick.service = std::chrono::milliseconds(500);
  Stop set = pick;
  set.kind = StopKind::SetDown;
  set.arc_m = path.back().arc_m;
  plan.missions[0].stops = {pick, set};
  FleetRig rig(plan, {.pallets = {{{{16.0 + 0.25 + 0.6 + 0.05, 10.0}, 0.0}}}});
  rig.run(120.0);
  EXPECT_TRUE(rig.all_arrived()) << rig.state();
  EXPECT_EQ(rig.truth("state_p1"), 1.0);
  const geometry::Pose at = rig.pose(0);
  const geometry::Point forks = geometry::from_frame(at, {0.9, 0.0});
  EXPECT_NEAR(rig.truth("x_p1"), forks.x_m, 0.1);
  EXPECT_NEAR(rig.truth("y_p1"), forks.y_m, 0.1);
  EXPECT_TRUE(rig.engines_agree);
  // Nothing there to lift.
  FleetRig empty(plan, {.native = false});
  empty.run(60.0);
  EXPECT_EQ(empty.of("ErrorID", 0), 29.0) << empty.state();
  EXPECT_NEAR(empty.of("Arc", 0), 6.0, 0.1);
}

// One vehicle begins 5 s after another has done its last stop; a deadline that cannot be kept is told, and
// kept ones are not.
TEST(FleetProgramRun, WhenConstraintsTieVehicles_ThenTheyWaitAndWhoIsLateSaysSo) {
  using namespace std::chrono_literals;
  constexpr std::chrono::milliseconds kNever{100'000'000};
  FleetPlan plan = plan_warehouse(2);
  const std::uint32_t first = waits_for(plan, 0)[1] ? 0 : 1;
  const std::uint32_t second = 1 - first;
  const auto last = [&](std::uint32_t v) {
    return PolygonRef{v, static_cast<std::uint32_t>(plan.missions[v].grown.visits.size() - 1)};
  };
  plan.constraints = {
      {"one after the other",
       TimepointRef{last(first), Side::Exit},
       {{second, 0}, Side::Entry},
       {5s, kNever}},
      {"first in time", std::nullopt, {last(first), Side::Exit}, {0s, 500s}},
      {"second in time", std::nullopt, {last(second), Side::Exit}, {0s, 20s}},
      {"second soon behind", TimepointRef{last(first), Side::Exit}, {last(second), Side::Exit}, {0s, 600s}}};
  FleetRig rig(plan, {});
  ASSERT_TRUE(rig.program().warnings.empty()) << result::to_string(rig.program().warnings);
  double done_s = 0.0, begun_s = 0.0, late_s = 0.0;
  const geometry::Pose stood = rig.pose(second);
  while (rig.time_s() < 400.0 && !rig.all_arrived()) {
    rig.scan();
    if (done_s == 0.0 && rig.arrived(first)) done_s = rig.time_s();
    const double moved_m = geometry::distance(rig.pose(second).position(), stood.position());
    if (begun_s == 0.0 && moved_m > 0.05) begun_s = rig.time_s();
    if (late_s == 0.0 && rig.global("late", second) != 0.0) late_s = rig.time_s();
  }
  EXPECT_TRUE(rig.all_arrived()) << rig.state();
  EXPECT_TRUE(rig.engines_agree);
  expect_safe(rig);
  ASSERT_GT(done_s, 0.0);
  EXPECT_GE(begun_s, done_s + 5.0) << rig.state();
  EXPECT_LT(begun_s, done_s + 8.0) << rig.state();
  EXPECT_EQ(rig.global("late", first), 0.0);
  EXPECT_NEAR(late_s, 20.0, 0.2);
  EXPECT_EQ(rig.global("late_for", second), 3.0);
  // Once it has come, a reset ends the alarm for good.
  rig.set("fleet_reset", true);
  rig.scan();
  rig.set("fleet_reset", false);
  for (int k = 0; k < 5; ++k) rig.scan();
  EXPECT_EQ(rig.global("late", second), 0.0);
  EXPECT_EQ(rig.global("late_for", second), 0.0);
}

}  // namespace
}  // namespace stepwright::fleet
