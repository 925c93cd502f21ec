#include "supervisor/fleet/mission/plan_fleet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <numbers>
#include <sstream>

#include "supervisor/fleet/mission/explain_schedule.h"
#include "supervisor/fleet/mission/fleet_svg.h"
#include "supervisor/fleet/mission/problem_reader.h"
#include "tests/unit/supervisor/fleet/mission/small_floor.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

MissionProblem example(const std::string& name) {
  const std::string file = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/fleet/" + name;
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return read_mission_problem(text.str(), file).value();
}

std::chrono::milliseconds end_of_stop(const FleetPlan& plan, std::size_t vehicle, std::size_t stop) {
  return plan.schedule.earliest[vehicle][plan.missions[vehicle].grown.stands[stop]].exit;
}

// Two loaders of the mine change places: on their shortest paths that cannot be, on others it can.
TEST(PlanFleet, Mine_WhenShortestPathsLeaveNoSchedule_ThenOneVehicleDrivesAroundAnother) {
  const MissionProblem mine = example("mine.json");
  FleetFloor floor = floor_of(mine);
  FleetOptions options{.objective = Objective::None, .time = 0ms, .alternatives = 0};
  const auto fixed = plan_fleet(mine, floor, options);
  ASSERT_TRUE(fixed.has_value());
  EXPECT_EQ(fixed->verdict, Verdict::Infeasible);
  EXPECT_EQ(fixed->proof, Proof::PathsFound);
  EXPECT_THAT(fixed->reason, HasSubstr("loader 2 and loader 5 meet at"));
  EXPECT_THAT(fixed->reason, HasSubstr("loader 2 stands there at its start"));
  options.alternatives = 48;
  const auto mended = plan_fleet(mine, floor, options);
  ASSERT_TRUE(mended.has_value());
  ASSERT_EQ(mended->verdict, Verdict::Scheduled) << mended->reason;
  EXPECT_EQ(mended->proof, Proof::None);
  ASSERT_FALSE(mended->changes.empty());
  EXPECT_GT(mended->changes.front().longer_m, 0.0);
  expect_sound(mine, mended->plan);
  EXPECT_THAT(fleet_svg(mended->plan, &mine.map), HasSubstr("loader 7"));
}

TEST(PlanFleet, Warehouse_WhenLoadsAreDivided_ThenAllAreCarriedWithinTheLimits) {
  const MissionProblem warehouse = example("warehouse.json");
  FleetOptions options;
  options.time = std::chrono::minutes(5);  // it ends by itself long before, on any machine
  options.path_factor = 2.0;
  const FleetAnswer answer = planned(warehouse, options);
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  expect_sound(warehouse, answer.plan);
  std::vector<std::uint32_t> carried(warehouse.goals.size());
  for (std::size_t v = 0; v < answer.plan.missions.size(); ++v) {
    const VehicleMission& mission = answer.plan.missions[v];
    for (std::size_t k = 0; k < mission.stops.size(); ++k) {
      const Stop& stop = mission.stops[k];
      EXPECT_LE(stop.aboard, warehouse.vehicles[v].capacity);
      for (std::size_t goal = 0; goal < warehouse.goals.size(); ++goal) {
        if (warehouse.goals[goal].name != stop.goal || stop.kind != StopKind::SetDown) continue;
        carried[goal] += stop.amount;
        if (stop.goal == "order 41") {
          EXPECT_LE(end_of_stop(answer.plan, v, k), 240s);
        }
        if (stop.goal == "order 42") {
          EXPECT_EQ(mission.vehicle, "truck 4");
        }
      }
    }
    EXPECT_EQ(mission.stops.back().kind, StopKind::Park);
  }
  for (std::size_t goal = 0; goal < carried.size(); ++goal)
    EXPECT_EQ(carried[goal], warehouse.goals[goal].amount);
}

TEST(PlanFleet, Stops_WhenServed_ThenTheServiceIsInTheStayThere) {
  MissionProblem problem = empty_problem();
  const auto v = add_vehicle(problem, "v1", {6, 6, 0});
  const auto dock = add_location(problem, "dock", {20, 6, 0}, 30s);
  const auto rack = add_location(problem, "rack", {34, 6, 0}, 10s);
  problem.goals.push_back(
      {.name = "load", .amount = 1, .from = dock, .to = rack, .vehicle = v, .key = "goals[0]"});
  const FleetAnswer answer = planned(problem);
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  expect_sound(problem, answer.plan);
  const VehicleMission& mission = answer.plan.missions[0];
  ASSERT_EQ(mission.stops.size(), 2u);
  EXPECT_EQ(mission.stops[0].aboard, 1u);
  // 14 m at 1.5 m/s, loading, 14 m, unloading.
  EXPECT_NEAR(static_cast<double>(end_of_stop(answer.plan, 0, 0).count()), 14000 / 1.5 + 30000, 5.0);
  EXPECT_NEAR(static_cast<double>(end_of_stop(answer.plan, 0, 1).count()), 28000 / 1.5 + 40000, 10.0);
  EXPECT_EQ(answer.plan.schedule.objective, end_of_stop(answer.plan, 0, 1));
  EXPECT_TRUE(answer.plan.schedule.proved_optimal);
}

// To the millisecond: what can just be met is met, and a millisecond less is refused with the limits named.
TEST(PlanFleet, Deadline_WhenJustMet_ThenScheduledAndOneMillisecondLessIsNot) {
  MissionProblem problem = empty_problem();
  const auto v = add_vehicle(problem, "v1", {6, 6, 0});
  const auto dock = add_location(problem, "dock", {20, 6, 0}, 30s);
  add_task(problem, v, dock);
  problem.vehicles[v].available = 7s;
  const FleetAnswer free = planned(problem);
  ASSERT_EQ(free.verdict, Verdict::Scheduled);
  const auto end = end_of_stop(free.plan, 0, 0);
  problem.constraints.push_back({.name = "lunch",
                                 .from = {},
                                 .to = {Moment::TaskEnd, 0},
                                 .distance = {0ms, end},
                                 .key = "constraints[0]"});
  EXPECT_EQ(planned(problem).verdict, Verdict::Scheduled);
  problem.constraints[0].distance.most = end - 1ms;
  const FleetAnswer late = planned(problem);
  EXPECT_EQ(late.verdict, Verdict::Infeasible);
  // Of all paths the times are known less exactly than to the millisecond.
  EXPECT_EQ(late.proof, Proof::PathsFound);
  problem.constraints[0].distance.most = end - 2s;
  EXPECT_EQ(planned(problem).proof, Proof::AllPaths);
  EXPECT_THAT(late.reason, HasSubstr("constraint 'lunch'"));
  EXPECT_THAT(late.reason, HasSubstr("constraint 'v1 is available'"));
  // The beginning of the service is as much sooner as the service takes.
  problem.constraints[0] = {.name = "arrives",
                            .from = {},
                            .to = {Moment::TaskStart, 0},
                            .distance = {0ms, end - 30s},
                            .key = "constraints[0]"};
  EXPECT_EQ(planned(problem).verdict, Verdict::Scheduled);
  problem.constraints[0].distance.most -= 5ms;
  EXPECT_EQ(planned(problem).verdict, Verdict::Infeasible);
}

// Two aisles, a parked vehicle in the nearer one.
TEST(PlanFleet, ParkedVehicle_WhenInTheShortestWay_ThenTheOtherAisleIsTaken) {
  MissionProblem problem = empty_problem();
  wall(problem, 12, 8.2, 28, 15);
  wall(problem, 12, 0, 28, 4);
  const auto v = add_vehicle(problem, "mover", {6, 6, 0});
  add_vehicle(problem, "sleeper", {20, 6, 0});
  add_task(problem, v, add_location(problem, "east", {35, 6, 0}));
  const FleetAnswer answer = planned(problem, {.path_factor = 1.5});
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  ASSERT_EQ(answer.changes.size(), 1u);
  EXPECT_EQ(answer.changes[0].vehicle, 0u);
  EXPECT_EQ(answer.changes[0].around, std::vector<std::uint32_t>{1});
  expect_sound(problem, answer.plan);
  // One wall more, and it is proved that no path leads past the sleeper.
  wall(problem, 12, 15, 28, 24);
  const FleetAnswer none = planned(problem, {.path_factor = 1.5});
  EXPECT_EQ(none.verdict, Verdict::Infeasible);
  EXPECT_EQ(none.proof, Proof::AllPaths);
  EXPECT_THAT(none.reason, HasSubstr("sleeper stands there all the time"));
  EXPECT_THAT(none.reason, HasSubstr("did not help"));
}

TEST(PlanFleet, Goal_WhenBehindAWall_ThenToldWithItsPlace) {
  MissionProblem problem = empty_problem();
  wall(problem, 20, 0, 21, 24);
  const auto v = add_vehicle(problem, "v1", {6, 6, 0});
  const auto east = add_location(problem, "east", {35, 6, 0});
  problem.goals.push_back(
      {.name = "load", .from = add_location(problem, "west", {12, 12, 0}), .to = east, .key = "goals[0]"});
  FleetFloor floor = floor_of(problem);
  const auto unreachable = plan_fleet(problem, floor, {});
  ASSERT_FALSE(unreachable.has_value());
  EXPECT_THAT(to_string(unreachable.error()),
              HasSubstr("F0801: goals[0]: no vehicle reaches 'west' and from there 'east'"));
  // The load could be carried, but not the task driven after it.
  problem.goals[0].to = add_location(problem, "near", {12, 18, 0});
  add_task(problem, v, east);
  const auto after = plan_fleet(problem, floor, {});
  ASSERT_FALSE(after.has_value());
  EXPECT_THAT(to_string(after.error()), HasSubstr("F0801: tasks[0]: 'v1' finds no way"));
  problem.goals.clear();
  const auto task = plan_fleet(problem, floor, {});
  ASSERT_FALSE(task.has_value());
  EXPECT_THAT(to_string(task.error()), HasSubstr("F0801: tasks[0]: 'v1' finds no way"));
}

TEST(PlanFleet, GivenParts_WhenAPathAndAnEnvelopeAreGiven_ThenOnlyTheRestIsPlanned) {
  MissionProblem problem = empty_problem();
  const auto v = add_vehicle(problem, "planned", {6, 6, 0});
  add_task(problem, v, add_location(problem, "east", {34, 6, 0}));
  const auto drawn = add_vehicle(problem, "drawn", {20, 18, -0.5 * std::numbers::pi});
  geometry::Path path;
  for (int k = 0; k <= 240; ++k) {
    path.push_back({{20, 18 - 0.05 * k, -0.5 * std::numbers::pi}, 0.05 * k, geometry::Travel::Forward});
  }
  problem.vehicles[drawn].path = path;
  const auto given = add_vehicle(problem, "given", {});
  const auto box = geometry::footprint_at({30, 6, 0}, {.front_m = 2, .rear_m = 2, .half_width_m = 2});
  problem.vehicles[given].envelope =
      TrajectoryEnvelope{.vehicle = "given",
                         .polygons = {{box, {5s, 20s}, {1s, 2s}},
                                      {geometry::footprint_at({30, 10.2, 0}, {2, 2, 2.6}), {5s, 20s}, {}}}};
  const FleetAnswer answer = planned(problem);
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  expect_sound(problem, answer.plan);
  EXPECT_EQ(answer.plan.missions[1].path.size(), path.size());
  EXPECT_TRUE(answer.plan.missions[2].path.empty());
  EXPECT_EQ(answer.plan.missions[2].grown.envelope.polygons.size(), 2u);
  EXPECT_GT(answer.plan.schedule.precedences.size(), 1u);
}

TEST(PlanFleet, Modes_WhenOneVehicleEndsWhereAnotherPasses_ThenOnlyThePaperForgetsIt) {
  MissionProblem problem = empty_problem();
  wall(problem, 0, 8, 40, 24);
  wall(problem, 0, 0, 40, 4);
  // In a tunnel the first one ends before the second has passed.
  const auto first = add_vehicle(problem, "first", {20, 6, 0});
  add_task(problem, first, add_location(problem, "middle", {28, 6, 0}));
  const auto second = add_vehicle(problem, "second", {6, 6, 0});
  add_task(problem, second, add_location(problem, "east", {36, 6, 0}));
  const FleetAnswer strict = planned(problem);
  EXPECT_EQ(strict.verdict, Verdict::Infeasible);
  EXPECT_EQ(strict.proof, Proof::PathsFound);
  const FleetAnswer paper = planned(problem, {.mode = Mode::EarliestTimes});
  ASSERT_EQ(paper.verdict, Verdict::Scheduled);
  expect_sound(problem, paper.plan, Mode::EarliestTimes);
}

// Who carries nothing may stand elsewhere: what is proved with a load in the tunnel is proved of that only.
TEST(PlanFleet, Proof_WhenLoadsAreSharedOut_ThenItIsOfThisAllocation) {
  MissionProblem problem = empty_problem();
  wall(problem, 0, 8, 40, 24);
  wall(problem, 0, 0, 40, 4);
  const auto first = add_vehicle(problem, "first", {16, 6, 0});
  const auto second = add_vehicle(problem, "second", {6, 6, 0});
  add_task(problem, second, add_location(problem, "east", {36, 6, 0}));
  problem.goals.push_back({.name = "load",
                           .from = add_location(problem, "here", {20, 6, 0}),
                           .to = add_location(problem, "there", {28, 6, 0}),
                           .vehicle = first,
                           .key = "goals[0]"});
  const FleetAnswer answer = planned(problem);
  EXPECT_EQ(answer.verdict, Verdict::Infeasible);
  EXPECT_EQ(answer.proof, Proof::ThisAllocation);
}

// Envelopes and paths that are all given leave no other paths to look for.
TEST(PlanFleet, Proof_WhenAllPathsAreGiven_ThenItIsOfAll) {
  MissionProblem problem = empty_problem();
  for (const double from_m : {6.0, 16.0}) {
    const auto v = add_vehicle(problem, from_m < 10 ? "behind" : "before", {from_m, 6, 0});
    geometry::Path path;
    for (int k = 0; k <= 400; ++k)
      path.push_back({{from_m + 0.05 * k, 6, 0}, 0.05 * k, geometry::Travel::Forward});
    problem.vehicles[v].path = path;
  }
  EXPECT_EQ(planned(problem).verdict, Verdict::Scheduled);
  std::ranges::reverse(*problem.vehicles[1].path);
  for (std::size_t k = 0; k < problem.vehicles[1].path->size(); ++k) {
    auto& at = (*problem.vehicles[1].path)[k];
    at.arc_m = 0.05 * static_cast<double>(k);
    at.travel = geometry::Travel::Reverse;
  }
  const FleetAnswer against = planned(problem);
  EXPECT_EQ(against.verdict, Verdict::Infeasible);
  EXPECT_EQ(against.proof, Proof::AllPaths);
}

// Before anything is searched, and the paths that are open then are given up at once.
TEST(PlanFleet, Cancel_WhenAskedForBefore_ThenCancelledAndNoPathIsSearchedFar) {
  const MissionProblem mine = example("mine.json");
  const std::atomic<bool> cancel = true;
  FleetFloor floor =
      FleetFloor::create(mine.map, models_of(mine), {.table_folder = {}, .cancel = &cancel}).value();
  const auto answer = plan_fleet(mine, floor, {.cancel = &cancel});
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->verdict, Verdict::Cancelled);
  for (const MissionTask& task : mine.tasks) {
    const PathAnswer* leg =
        floor.find({0, mine.vehicles[task.vehicle].start, mine.locations[task.location].pose});
    if (leg == nullptr) continue;
    EXPECT_EQ(leg->end, PathEnd::Cancelled);
    EXPECT_LE(leg->expanded, 256U);
  }
}

TEST(PlanFleet, Time_WhenItIsOverBeforeThePaths_ThenExhausted) {
  const MissionProblem mine = example("mine.json");
  const FleetAnswer answer = planned(mine, {.time = 1ms});
  EXPECT_EQ(answer.verdict, Verdict::Exhausted);
  EXPECT_THAT(answer.reason, Not(HasSubstr("proved")));
}

TEST(PlanFleet, Waits_WhenOneGoesFirst_ThenTheOtherOnesWaitIsTold) {
  MissionProblem problem = empty_problem();
  add_task(problem, add_vehicle(problem, "along", {6, 12, 0}), add_location(problem, "east", {35, 12, 0}));
  add_task(problem, add_vehicle(problem, "across", {20, 4, 0.5 * std::numbers::pi}),
           add_location(problem, "north", {20, 20, 0.5 * std::numbers::pi}));
  problem.vehicles[1].available = 4s;
  const FleetAnswer answer = planned(problem);
  ASSERT_EQ(answer.verdict, Verdict::Scheduled);
  const auto waits = waits_of(answer.plan);
  ASSERT_FALSE(waits.empty());
  EXPECT_GE(waits[0].until - waits[0].from, 100ms);
  EXPECT_NE(waits[0].waiting, waits[0].first);
  EXPECT_NEAR(waits[0].place.x_m, 20.0, 6.0);
}

}  // namespace
}  // namespace stepwright::fleet
