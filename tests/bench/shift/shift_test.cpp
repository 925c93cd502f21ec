#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/bench/shift/dispatcher.h"
#include "tests/bench/shift/driver.h"
#include "tests/bench/shift/plant_run.h"
#include "tests/bench/shift/reach.h"

namespace stepwright::bench::shift {
namespace {

constexpr geometry::Footprint kOutline{.front_m = 1.6, .rear_m = 2.4, .half_width_m = 0.7};

// A few minutes on the simulated plant, with a blocked aisle and a vehicle that dies and comes back.
TEST(Shift, WhenAnAisleIsBlockedAndAVehicleDies_ThenNothingCollidesAndEverybodyGetsOn) {
  Scenario scenario = draw_scenario({.vehicles = 4, .hours = 0.08, .transports_per_hour = 60.0, .seed = 4});
  scenario.transports.resize(std::min<std::size_t>(scenario.transports.size(), 4));
  for (std::size_t k = 0; k < scenario.transports.size(); ++k)
    scenario.transports[k].release_s = 2.0 * static_cast<double>(k);
  scenario.closings = {{40.0, 60.0, 3}};
  scenario.breakdowns = {{1, 50.0, 30.0, false}};
  Fleet fleet(scenario, scenario.settings.vehicles);
  const PlantRun run = run_on_plant(scenario, fleet, false);
  ASSERT_EQ(run.failed, "");
  EXPECT_TRUE(run.collisions.empty());
  EXPECT_EQ(run.contacts, 0U);
  EXPECT_EQ(run.deadlocks, std::vector<std::string>{});
  EXPECT_EQ(run.lost, 0U);
  EXPECT_LT(run.largest_deviation_m, 0.2);
  EXPECT_GT(run.outline_checks, 10'000U);
  const auto done = std::ranges::count_if(run.figures.deliveries,
                                          [](const Delivery& d) { return d.delivered_s.has_value(); });
  EXPECT_GE(done, 2);
  const auto told = [&](const char* what) {
    return std::ranges::any_of(run.log,
                               [&](const std::string& line) { return line.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(told("is blocked"));
  EXPECT_TRUE(told("v2 is dead"));
  EXPECT_TRUE(told("v2 is back"));
}

// A vehicle without lags, as it is told.
fleet::VehicleState driven(const fleet::VehicleState& from, const fleet::DriveCommand& command) {
  constexpr double kStep_s = 0.1;
  const double wheelbase_m = limits_of_the_plant().wheelbase_m;
  fleet::VehicleState to = from;
  to.speed_m_s = command.speed_m_s;
  to.lock_rad = command.lock_rad;
  to.x_m += kStep_s * to.speed_m_s * std::cos(from.heading_rad);
  to.y_m += kStep_s * to.speed_m_s * std::sin(from.heading_rad);
  to.heading_rad += kStep_s * to.speed_m_s * std::tan(to.lock_rad) / wheelbase_m;
  return to;
}

// It stood 0.3 m before the place that it might not pass, and so before a stop that it might go to.
TEST(Driver, WhenItsStopIsJustBeforeThePlaceThatItMayNotPass_ThenItDrivesToTheStop) {
  const Scenario scenario = draw_scenario({.vehicles = 1, .hours = 0.1});
  Fleet fleet(scenario, 1);
  fleet::Waypoint dock{scenario.hall.docks[0], {}};
  dock.stop.kind = fleet::StopKind::PickUp;
  const geometry::Pose home = fleet.planner().home(0);
  const std::array<fleet::Waypoint, 2> stops = {dock, fleet::Waypoint{home, {}}};
  const fleet::Route route = fleet.planner().plan(0, home, stops).value();
  Driver driver(route, limits_of_the_plant(), kOutline);
  const fleet::Permission permission{route.mission.stops[0].arc_m + 0.1, {}};
  fleet::VehicleState at{home.x_m, home.y_m, home.heading_rad, 0.0, 0.0};
  for (int k = 0; k < 3000 && driver.arrived_at() == nullptr; ++k) {
    const Driver::Drive drive = driver.step(at, permission, 0.1 * k, false);
    ASSERT_FALSE(driver.lost()) << k;
    at = driven(at, drive.command);
  }
  ASSERT_NE(driver.arrived_at(), nullptr);
  EXPECT_NEAR(geometry::distance({at.x_m, at.y_m}, dock.pose.position()), 0.0, 0.1);
  // There it waits for more only once it wants to go on.
  EXPECT_FALSE(driver.waits());
}

// A new way used to begin where it had been when the pause began: behind it, up to more than half a metre.
TEST(Driver, WhenItIsPausedWhileItDrives_ThenItTellsHowFarItComesUntilItStands) {
  const Scenario scenario = draw_scenario({.vehicles = 1, .hours = 0.1});
  Fleet fleet(scenario, 1);
  const geometry::Pose home = fleet.planner().home(0);
  const std::array<fleet::Waypoint, 1> stops = {fleet::Waypoint{scenario.hall.docks[0], {}}};
  const fleet::Route route = fleet.planner().plan(0, home, stops).value();
  Driver driver(route, limits_of_the_plant(), kOutline);
  fleet::VehicleState at{home.x_m, home.y_m, home.heading_rad, 0.0, 0.0};
  int k = 0;
  for (; k < 600 && std::abs(at.speed_m_s) < 1.0; ++k)
    at = driven(at, driver.step(at, {1e9, {}}, 0.1 * k, false).command);
  ASSERT_GE(std::abs(at.speed_m_s), 1.0);
  const double begin_m = driver.location().arc_m;
  for (int left = 10; left >= 0; --left, ++k) {
    at = driven(at, {at.speed_m_s * (left > 0 ? 0.85 : 0.0), at.lock_rad});
    driver.step(at, {1e9, {}}, 0.1 * k, true);
  }
  const double arc_m = driver.location().arc_m;
  EXPECT_GT(arc_m, begin_m + 0.4);
  const auto place = std::ranges::lower_bound(route.mission.path, arc_m, {}, &geometry::PathPose::arc_m);
  EXPECT_LT(geometry::distance(place->pose.position(), {at.x_m, at.y_m}), 0.15);
}

// The nearest one used to be asked again and again, also if it stood where no way led out.
TEST(Dispatch, WhenTheNearestVehicleWasRefused_ThenTheNextOneIsAskedUntilAllHaveBeen) {
  const EarliestDueNearestVehicle rule;
  const std::vector<FreeVehicle> free = {{0, {10.0, 8.0, 0.0}}, {1, {40.0, 8.0, 0.0}}, {2, {20.0, 8.0, 0.0}}};
  std::vector<std::uint32_t> refused;
  const auto chosen = [&] {
    const std::vector<Waiting> waiting = {{7, 100.0, {9.0, 8.0, 0.0}, refused}};
    return rule.choose(waiting, free).front().vehicle;
  };
  EXPECT_EQ(chosen(), 0U);
  refused = {0};
  EXPECT_EQ(chosen(), 2U);
  refused = {0, 2};
  EXPECT_EQ(chosen(), 1U);
  refused = {0, 2, 1};
  EXPECT_EQ(chosen(), 0U);
}

// From the left dock to the right one, with a row of places blocked between them.
class ReachTest : public testing::Test {
 protected:
  static constexpr ReachOptions kCoarse{.step_m = 0.1};
  static Standing wall(Rectangle area, double begin_s, double end_s) {
    return {area.polygon(), begin_s, end_s};
  }
  Scenario scenario = draw_scenario({.vehicles = 1, .hours = 0.1});
  Transport transport{
      .release_s = 100.0, .due_s = 1000.0, .from = 0, .to = 1, .pick_up_s = 20.0, .set_down_s = 10.0};
  double way_s = geometry::distance(scenario.stations[0].position(), scenario.stations[1].position()) / 1.5;
  double earliest_s(std::span<const Standing> stood, const ReachOptions& options = kCoarse,
                    const Delivery& delivery = {}) const {
    return earliest_delivery_s(scenario, stood, transport, ready_at(scenario, stood, transport, delivery),
                               options);
  }
};

TEST_F(ReachTest, WhenAPassageIsOpen_ThenOnlyTheStraightWayCounts) {
  EXPECT_NEAR(earliest_s({}), 130.0 + way_s, 1e-9);
  // All of the hall but a gap of the vehicle's width and a little more.
  const std::vector<Standing> gap = {wall({{36.0, 0.0}, {37.0, 7.0}}, 0.0, 500.0),
                                     wall({{36.0, 8.65}, {37.0, 66.0}}, 0.0, 500.0)};
  EXPECT_NEAR(earliest_s(gap), 130.0 + way_s, 1e-9);
  EXPECT_NEAR(earliest_s({}, {.radius_m = 1.3, .step_m = 0.1}), 130.0 + way_s, 1e-9);
}

TEST_F(ReachTest, WhenNothingFitsThrough_ThenItComesThroughWhenThatEndsAndNotBefore) {
  const std::vector<Standing> shut = {wall({{36.0, 0.0}, {37.0, 7.0}}, 0.0, 500.0),
                                      wall({{36.0, 8.4}, {37.0, 66.0}}, 0.0, 800.0)};
  // From the wall on; it could have come so far.
  const double rest_s = (scenario.stations[1].x_m - 36.0) / 1.5;
  const double at_s = earliest_s(shut);
  EXPECT_GT(at_s, 500.0 + 10.0 + rest_s);
  EXPECT_LT(at_s, 500.0 + 10.0 + rest_s + 2.0);
  // Who was in front of it before it closed is past it, and so is who only has to be delivered.
  const std::vector<Standing> later = {wall({{36.0, 0.0}, {37.0, 66.0}}, 121.0, 800.0)};
  EXPECT_NEAR(earliest_s(later), 130.0 + way_s, 1e-9);
  // Nobody comes at all to a place on which somebody stands for good.
  const std::vector<Standing> on_it = {{geometry::footprint_at(scenario.stations[1], kOutline), 0.0, 1e300}};
  EXPECT_TRUE(earliest_s(on_it) > 1e200);
}

// Nobody takes it from the forks of a vehicle that is dead. Before it was picked up, or of another one, its
// death keeps nobody.
TEST_F(ReachTest, WhenAVehicleDiesWithTheLoad_ThenItComesNoFartherUntilThatOneIsBack) {
  const geometry::Pose half_way{36.0, 7.0, 0.0};
  std::vector<Standing> stood = {
      {geometry::footprint_at(half_way, kOutline), 200.0, 600.0, 4U, half_way.position()}};
  const double rest_s =
      geometry::distance(half_way.position(), scenario.stations[transport.to].position()) / 1.5;
  Delivery delivery;
  delivery.vehicle = 4;
  delivery.picked_s = 180.0;
  EXPECT_NEAR(earliest_s(stood, kCoarse, delivery), 600.0 + rest_s + 10.0, 0.2);
  delivery.delivered_s = 700.0;
  EXPECT_NEAR(earliest_s(stood, kCoarse, delivery), 600.0 + rest_s + 10.0, 0.2);
  delivery.picked_s = 620.0;
  EXPECT_NEAR(earliest_s(stood, kCoarse, delivery), 130.0 + way_s, 1e-9);
  delivery.picked_s = 150.0;
  delivery.vehicle = 3;
  EXPECT_NEAR(earliest_s(stood, kCoarse, delivery), 130.0 + way_s, 1e-9);
  delivery.vehicle = 4;
  stood[0].end_s = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isinf(earliest_s(stood, kCoarse, delivery)));
}

// What the bound says nobody can do the planner does not find either; where it finds a way the bound is less.
TEST_F(ReachTest, WhenAWayIsDriven_ThenItTakesLongerThanTheBound) {
  Fleet fleet(scenario, 1);
  for (const std::uint32_t to : {3U, 14U, 20U}) {
    transport.to = to;
    const std::vector<fleet::Waypoint> stops = {{scenario.stations[to], {}}};
    const auto way = fleet.planner().plan(0, scenario.stations[0], stops);
    ASSERT_TRUE(way.has_value());
    const double driven_s = 120.0 + way->pace.time_s(way->end_m()) + 10.0;
    EXPECT_LT(earliest_s({}), driven_s);
  }
}

class JudgeTest : public testing::Test {
 protected:
  static Scenario two_vehicles() { return draw_scenario({.vehicles = 2, .hours = 0.1}); }
  Scenario scenario = two_vehicles();
  Judge judge{scenario, kOutline};
};

TEST_F(JudgeTest, WhenOutlinesOverlap_ThenItIsACollisionOnce) {
  // Side by side with 5 cm between them; then 5 cm into each other.
  judge.step(0.01, std::vector<geometry::Pose>{{20.0, 9.0, 0.0}, {20.0, 10.45, 0.0}});
  EXPECT_TRUE(judge.collisions().empty());
  EXPECT_NEAR(judge.smallest_gap_m(), 0.05, 1e-9);
  judge.step(0.02, std::vector<geometry::Pose>{{20.0, 9.0, 0.0}, {20.0, 10.35, 0.0}});
  judge.step(0.03, std::vector<geometry::Pose>{{20.01, 9.0, 0.0}, {20.0, 10.35, 0.0}});
  ASSERT_EQ(judge.collisions().size(), 1U);
  EXPECT_EQ(judge.collisions()[0].with, "vehicle 2");
}

TEST_F(JudgeTest, WhenAnOutlineMeetsARackOrABlockedPlace_ThenItIsACollision) {
  const geometry::Pose far{50.0, 9.0, 0.0};
  judge.step(0.01, std::vector<geometry::Pose>{{20.0, 13.25, 0.0}, far});  // the rack begins at y = 14
  EXPECT_TRUE(judge.collisions().empty());
  judge.step(0.02, std::vector<geometry::Pose>{{20.0, 13.35, 0.0}, far});
  ASSERT_EQ(judge.collisions().size(), 1U);
  EXPECT_EQ(judge.collisions()[0].with, "wall");
  const geometry::Point place = scenario.places[0].low;
  judge.step(0.03, std::vector<geometry::Pose>{{place.x_m - 1.0, 18.0, 0.0}, far});
  EXPECT_EQ(judge.collisions().size(), 1U);
  judge.block(0, true);
  judge.step(0.04, std::vector<geometry::Pose>{{place.x_m - 1.1, 18.0, 0.0}, far});
  EXPECT_EQ(judge.collisions().size(), 2U);
}

TEST_F(JudgeTest, WhenVehiclesWaitForEachOtherOrNobody_ThenItIsADeadlock) {
  const std::vector<geometry::Pose> poses = {{20.0, 9.0, 0.0}, {40.0, 9.0, 0.0}};
  judge.standing(0.0, poses, std::vector<VehicleState>{{Doing::Waits, 1U}, {Doing::Stands, {}}});
  EXPECT_TRUE(judge.deadlocks().empty());
  judge.standing(1.0, poses, std::vector<VehicleState>{{Doing::Waits, 1U}, {Doing::Waits, 0U}});
  EXPECT_EQ(judge.deadlocks().size(), 2U);
  Judge other(scenario, kOutline);
  for (int s = 0; s <= 60; ++s)
    other.standing(s, poses, std::vector<VehicleState>{{Doing::Waits, {}}, {Doing::Rests, {}}});
  EXPECT_EQ(other.deadlocks().size(), 1U);
  Judge third(scenario, kOutline);
  for (int s = 0; s <= 60; ++s)
    third.standing(s, poses, std::vector<VehicleState>{{Doing::Drives, {}}, {Doing::Held, {}}});
  EXPECT_EQ(third.deadlocks().size(), 1U);
}

}  // namespace
}  // namespace stepwright::bench::shift
