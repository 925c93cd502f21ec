#include "supervisor/fleet/mission/add_mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "supervisor/fleet/schedule/retiming.h"
#include "tests/unit/supervisor/fleet/mission/small_floor.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

// Two vehicles that cross, and a third one that idles.
struct Running {
  Running() {
    add_task(problem, add_vehicle(problem, "v1", {6, 6, 0}), add_location(problem, "east", {34, 6, 0}));
    add_task(problem, add_vehicle(problem, "v2", {20, 18, -1.5707963}),
             add_location(problem, "south", {20, 4, -1.5707963}));
    add_vehicle(problem, "v3", {6, 12, 0});
    floor.emplace(floor_of(problem));
    plan = plan_fleet(problem, *floor, {.alternatives = 0}).value().plan;
    EXPECT_EQ(plan.schedule.verdict, Verdict::Scheduled);
  }

  RunningPlan at(std::chrono::milliseconds now) const {
    const auto envelopes = envelopes_of(plan);
    return {.now = now, .times = Retiming(envelopes, plan.constraints, plan.schedule).earliest()};
  }

  MissionProblem problem = empty_problem();
  std::optional<FleetFloor> floor;
  FleetPlan plan;
};

TEST(AddMission, Mission_WhenAPlanRuns_ThenAppendedAndTheOthersKeepPathsAndOrders) {
  Running running;
  const NewMission mission{.stops = {{StopKind::PickUp, "dock", {34, 12, 0}, 5s, "load", 1},
                                     {StopKind::SetDown, "rack", {34, 18, 3.14159}, 5s, "load", 1}},
                           .vehicles = {2}};
  const RunningPlan now = running.at(8s);
  const AddedMission added = add_mission(*running.floor, running.plan, now, mission, {});
  ASSERT_EQ(added.verdict, Verdict::Scheduled) << added.reason;
  expect_sound(running.problem, added.plan);
  for (const std::size_t v : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_EQ(added.plan.missions[v].path.size(), running.plan.missions[v].path.size());
    for (std::size_t k = 0; k < now.times[v].size(); ++k) {
      // What has happened is not changed, and what is to come is no sooner.
      if (now.times[v][k].entry < 8s) {
        EXPECT_EQ(added.plan.schedule.earliest[v][k].entry, now.times[v][k].entry);
      }
      EXPECT_GE(added.plan.schedule.earliest[v][k].exit, now.times[v][k].exit);
    }
  }
  const VehicleMission& extended = added.plan.missions[2];
  ASSERT_EQ(extended.stops.size(), 2u);
  EXPECT_EQ(extended.stops[0].aboard, 1u);
  EXPECT_EQ(extended.stops[1].aboard, 0u);
  ASSERT_EQ(extended.grown.stands.size(), 2u);
  const VehicleTimes& times = added.plan.schedule.earliest[2];
  EXPECT_GE(times[1].entry, 8s);
  EXPECT_EQ(extended.grown.visits.back().last_pose + 1, extended.path.size());
  // Each old order is one of the new plan's, or follows from it.
  for (const Precedence& old : running.plan.schedule.precedences) {
    EXPECT_LE(added.plan.schedule.earliest[old.first.vehicle][old.first.polygon].exit,
              added.plan.schedule.earliest[old.second.vehicle][old.second.polygon].entry);
  }
}

TEST(AddMission, Vehicle_WhenNoneIsNamed_ThenWhoIsThereSoonest) {
  Running running;
  const NewMission mission{.stops = {{StopKind::Park, "near", {12, 16, 0}}}, .vehicles = {}};
  const AddedMission added = add_mission(*running.floor, running.plan, running.at(1s), mission, {});
  ASSERT_EQ(added.verdict, Verdict::Scheduled) << added.reason;
  EXPECT_EQ(added.vehicle, 2u);
}

TEST(AddMission, Twice_WhenTheFirstOneRuns_ThenTheSecondGoesOnFromItsEnd) {
  Running running;
  AddedMission added = add_mission(*running.floor, running.plan, running.at(1s),
                                   {.stops = {{StopKind::Park, "a", {30, 12, 0}}}, .vehicles = {2}}, {});
  ASSERT_EQ(added.verdict, Verdict::Scheduled) << added.reason;
  running.plan = added.plan;
  added = add_mission(*running.floor, running.plan, running.at(2s),
                      {.stops = {{StopKind::Park, "b", {34, 20, 0}}}, .vehicles = {2}}, {});
  ASSERT_EQ(added.verdict, Verdict::Scheduled) << added.reason;
  expect_sound(running.problem, added.plan);
  EXPECT_EQ(added.plan.missions[2].stops.size(), 2u);
}

TEST(AddMission, Place_WhenAnotherVehicleStandsThereForGood_ThenRefusedWithTheReason) {
  Running running;
  const AddedMission added =
      add_mission(*running.floor, running.plan, running.at(60s),
                  {.stops = {{StopKind::Park, "taken", {34, 6, 0}}}, .vehicles = {2}}, {});
  EXPECT_EQ(added.verdict, Verdict::Infeasible);
  EXPECT_THAT(added.reason, HasSubstr("v1 and v3 meet"));
  EXPECT_THAT(added.reason, HasSubstr("v1 stays there at 'east'"));
}

TEST(AddMission, Place_WhenInAWall_ThenRefused) {
  Running running;
  const AddedMission added =
      add_mission(*running.floor, running.plan, running.at(1s),
                  {.stops = {{StopKind::Park, "off", {39.5, 6, 0}}}, .vehicles = {2}}, {});
  EXPECT_EQ(added.verdict, Verdict::Infeasible);
  EXPECT_THAT(added.reason, HasSubstr("v3: "));
}

}  // namespace
}  // namespace stepwright::fleet
