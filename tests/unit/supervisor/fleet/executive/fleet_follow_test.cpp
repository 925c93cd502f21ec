#include "supervisor/fleet/executive/fleet_follow.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/fleet_program/planned_fleet.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;

class FleetFollowTest : public testing::Test {
 protected:
  static const FleetPlan& plan() {
    static const FleetPlan made = plan_warehouse(5);
    return made;
  }
  static const FleetProgram& program() {
    static const FleetProgram made =
        fleet_program(plan(), terminals_in_a_row(plan().missions.size()), {}).value();
    return made;
  }

  static std::uint32_t vehicles() { return static_cast<std::uint32_t>(plan().missions.size()); }

  // Every vehicle where the schedule has it at that time.
  static FleetReading on_time(milliseconds now) {
    FleetReading reading;
    for (std::uint32_t v = 0; v < vehicles(); ++v) {
      VehicleReading at;
      const auto& times = plan().schedule.earliest[v];
      while (at.areas + 1 < times.size() && times[at.areas].exit <= now) ++at.areas;
      at.arc_m = plan().missions[v].grown.visits[at.areas].entry_m;
      at.step = step_of(v, MissionStepKind::Polygon, at.areas);
      reading.vehicles.push_back(at);
    }
    return reading;
  }

  static std::size_t step_of(std::uint32_t v, MissionStepKind kind, std::size_t polygon) {
    const auto& steps = program().missions[v].steps;
    const auto found = std::ranges::find_if(steps, [&](const MissionStep& s) {
      return s.kind == kind && (kind != MissionStepKind::Polygon || s.polygon == polygon);
    });
    return static_cast<std::size_t>(found - steps.begin());
  }
};

TEST_F(FleetFollowTest, WhenEverybodyIsOnTime_ThenNobodyIsLate) {
  FleetFollow follow(plan(), program(), {});
  for (milliseconds now = 0ms; now < 60s; now += 500ms) {
    const FollowNews news = follow.take(on_time(now), now);
    EXPECT_TRUE(news.delays.empty()) << now.count();
    EXPECT_TRUE(news.errors.empty());
  }
  EXPECT_EQ(follow.retimings(), 0u);
}

TEST_F(FleetFollowTest, WhenAVehicleIsLate_ThenItAndWhoeverComesBehindItArriveLater) {
  bool others = false;
  for (std::uint32_t late = 0; late < vehicles(); ++late) {
    FleetFollow follow(plan(), program(), {.late = 3s});
    const auto before = follow.vehicles();
    const milliseconds now = plan().schedule.earliest[late][0].exit + 20s;
    FleetReading reading = on_time(now);
    reading.vehicles[late].areas = 0;
    reading.vehicles[late].arc_m = 0.0;
    reading.vehicles[late].step = step_of(late, MissionStepKind::Polygon, 0);
    const FollowNews news = follow.take(reading, now);
    ASSERT_EQ(news.delays.size(), 1u) << late;
    EXPECT_EQ(news.delays[0].vehicle, late);
    EXPECT_EQ(news.delays[0].late, 20s);
    EXPECT_EQ(follow.retimings(), 1u);
    EXPECT_GT(follow.vehicles()[late].arrives, before[late].arrives);
    EXPECT_EQ(follow.vehicles()[late].delay, follow.vehicles()[late].arrives - before[late].arrives);
    for (const std::uint32_t other : news.delays[0].others) {
      others = true;
      EXPECT_GT(follow.vehicles()[other].arrives, before[other].arrives);
    }
    // The same moment again is no news.
    EXPECT_TRUE(follow.take(reading, now).delays.empty());
  }
  EXPECT_TRUE(others);
}

TEST_F(FleetFollowTest, WhenADelayBreaksADeadline_ThenItIsNamedAndBindsNoMore) {
  FleetPlan bound = plan();
  const auto last = static_cast<std::uint32_t>(bound.missions[0].grown.visits.size() - 1);
  const milliseconds end = bound.schedule.earliest[0][last].exit;
  bound.constraints.push_back(
      {.name = "deadline of flour", .from = {}, .to = {{0, last}, Side::Exit}, .distance = {0ms, end + 5s}});
  FleetFollow follow(bound, program(), {.late = 3s});
  const milliseconds now = bound.schedule.earliest[0][0].exit + 300s;
  FleetReading reading = on_time(now);
  reading.vehicles[0].areas = 0;
  reading.vehicles[0].arc_m = 0.0;
  reading.vehicles[0].step = step_of(0, MissionStepKind::Polygon, 0);
  const FollowNews news = follow.take(reading, now);
  ASSERT_FALSE(news.delays.empty());
  EXPECT_EQ(news.delays[0].broken, std::vector<std::string>({"deadline of flour"}));
  EXPECT_GT(follow.vehicles()[0].arrives, end + 5s);
  EXPECT_TRUE(follow.plan().constraints.back().distance.most > 10'000s);
}

TEST_F(FleetFollowTest, WhenStopsBeginAndEnd_ThenEachIsToldOnce) {
  FleetFollow follow(plan(), program(), {});
  FleetReading reading = on_time(0ms);
  reading.vehicles[1].step = step_of(1, MissionStepKind::Stop, 0);
  FollowNews news = follow.take(reading, 1s);
  ASSERT_EQ(news.begun.size(), 1u);
  EXPECT_EQ(news.begun[0].vehicle, 1u);
  EXPECT_TRUE(news.stops.empty());
  EXPECT_EQ(follow.vehicles()[1].state, DriveState::Serving);
  EXPECT_TRUE(follow.take(reading, 1s).begun.empty());
  ++reading.vehicles[1].step;
  news = follow.take(reading, 2s);
  EXPECT_EQ(news.stops.size(), 1u);
  EXPECT_EQ(follow.vehicles()[1].stops_done, 1u);
}

TEST_F(FleetFollowTest, WhenAVehicleStopsByItself_ThenThatIsToldOnceAndLostOnesAreNot) {
  FleetFollow follow(plan(), program(), {.lost = {true, false, false, false, false}});
  FleetReading reading = on_time(0ms);
  reading.vehicles[0].error = 22;
  reading.vehicles[2].error = 27;
  EXPECT_EQ(follow.take(reading, 0ms).errors, std::vector<std::uint32_t>({2}));
  EXPECT_EQ(follow.vehicles()[0].state, DriveState::Lost);
  EXPECT_EQ(follow.vehicles()[2].state, DriveState::Stopped);
  EXPECT_TRUE(follow.take(reading, 0ms).errors.empty());
}

TEST_F(FleetFollowTest, WhenAllAreAtTheirEnds_ThenItIsFinished) {
  FleetFollow follow(plan(), program(), {});
  FleetReading reading = on_time(100'000s);
  EXPECT_FALSE(follow.take(reading, 0ms).finished);
  for (std::uint32_t v = 0; v < vehicles(); ++v)
    reading.vehicles[v].step = step_of(v, MissionStepKind::Done, 0);
  EXPECT_TRUE(follow.take(reading, 0ms).finished);
}

}  // namespace
}  // namespace stepwright::fleet
