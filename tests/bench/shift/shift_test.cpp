#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bench/shift/plant_run.h"

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
  const PlantRun run = run_on_plant(scenario, false);
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
