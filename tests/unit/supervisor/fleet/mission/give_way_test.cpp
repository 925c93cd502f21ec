// Fleets that stand so that no paths leave a schedule: somebody drives out of the way first.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/unit/supervisor/fleet/mission/small_floor.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr double kEast = 0.0, kNorth = 0.5 * std::numbers::pi, kWest = std::numbers::pi;

FleetOptions moving(std::uint32_t vehicles) {
  return {.objective = Objective::None,
          .time = 0ms,
          .path_factor = 1.5,
          .alternatives = 24,
          .give_way = vehicles,
          .conflicts = 20'000};
}

// An aisle 4 m wide from x = 8 to x = 32 m between two open floors.
MissionProblem aisle() {
  MissionProblem problem = empty_problem();
  wall(problem, 8, 0, 32, 4);
  wall(problem, 8, 8, 32, 24);
  return problem;
}

std::size_t send(MissionProblem& problem, const std::string& name, const geometry::Pose& from,
                 const geometry::Pose& to) {
  const std::size_t v = add_vehicle(problem, name, from);
  add_task(problem, v, add_location(problem, "of " + name, to));
  return v;
}

MissionProblem face_to_face(double gap_m) {
  MissionProblem problem = aisle();
  send(problem, "eastbound", {16, 6, kEast}, {36, 18, kNorth});
  send(problem, "westbound", {19.2 + gap_m, 6, kWest}, {4, 18, kNorth});
  return problem;
}

const Stop& give_way_stop(const FleetPlan& plan, std::size_t vehicle) {
  static const Stop kNone{};
  const auto& stops = plan.missions[vehicle].stops;
  const auto found = std::ranges::find(stops, StopKind::GiveWay, &Stop::kind);
  return found == stops.end() ? kNone : *found;
}

void expect_all_arrive(const MissionProblem& problem, const FleetPlan& plan) {
  for (const MissionTask& task : problem.tasks) {
    const geometry::Point goal = problem.locations[task.location].pose.position();
    const VehicleMission& mission = plan.missions[task.vehicle];
    EXPECT_LT(geometry::distance(mission.path.back().pose.position(), goal), 0.01) << mission.vehicle;
    EXPECT_EQ(mission.stops.back().kind, StopKind::Park) << mission.vehicle;
  }
}

TEST(GiveWay, WhenTwoStandFaceToFaceInAnAisle_ThenOneBacksOutAndGoesOnBehindTheOther) {
  const MissionProblem problem = face_to_face(4.0);
  EXPECT_EQ(planned(problem, moving(0)).verdict, Verdict::Infeasible);
  const FleetAnswer answer = planned(problem, moving(2));
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  ASSERT_EQ(answer.gave_way.size(), 1U);
  const GaveWay& move = answer.gave_way[0];
  expect_sound(problem, answer.plan);
  expect_all_arrive(problem, answer.plan);
  const Stop& stop = give_way_stop(answer.plan, move.vehicle);
  ASSERT_EQ(stop.kind, StopKind::GiveWay);
  EXPECT_LT(geometry::distance(answer.plan.missions[move.vehicle].path[stop.pose].pose.position(),
                               move.place.position()),
            1e-6);
  // It has to leave the aisle, and no more.
  EXPECT_LT(stop.arc_m, 25.0);
  const std::uint32_t other = 1 - move.vehicle;
  EXPECT_LT(answer.plan.schedule.earliest[other].back().exit,
            answer.plan.schedule.earliest[move.vehicle].back().exit);
}

// Counted and not timed: on every machine the same.
TEST(GiveWay, WhenABudgetOfWorkEnds_ThenTheAnswerSaysThatThereMayBeMore) {
  const MissionProblem problem = face_to_face(4.0);
  FleetOptions options = moving(2);
  options.expansions = 1;
  const FleetAnswer none = planned(problem, options);
  EXPECT_EQ(none.verdict, Verdict::Infeasible);
  EXPECT_THAT(none.reason, HasSubstr("a budget of work ended before more was tried"));
  options.expansions = 1'000'000;
  EXPECT_EQ(planned(problem, options).verdict, Verdict::Scheduled);
}

// What a stand's polygon grows by used to leave no schedule on any paths.
TEST(GiveWay, WhenTheyNearlyTouch_ThenOneBacksOutAllTheSame) {
  const MissionProblem problem = face_to_face(0.4);
  const FleetAnswer answer = planned(problem, moving(1));
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  EXPECT_EQ(answer.gave_way.size(), 1U);
  expect_sound(problem, answer.plan);
  expect_all_arrive(problem, answer.plan);
}

TEST(GiveWay, WhenWhoStandsInTheWayHasNothingToDo_ThenItIsTheOneThatMoves) {
  MissionProblem problem = aisle();
  const auto mover = send(problem, "mover", {4, 6, kEast}, {36, 6, kEast});
  const auto sleeper = add_vehicle(problem, "sleeper", {20, 6, kEast});
  const FleetAnswer answer = planned(problem, moving(1));
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  ASSERT_EQ(answer.gave_way.size(), 1U);
  EXPECT_EQ(answer.gave_way[0].vehicle, sleeper);
  EXPECT_EQ(answer.plan.missions[sleeper].stops.size(), 1U);
  EXPECT_EQ(give_way_stop(answer.plan, sleeper).kind, StopKind::GiveWay);
  EXPECT_EQ(answer.plan.missions[mover].stops.size(), 1U);
  expect_sound(problem, answer.plan);
}

// The first one comes out of a dead end; the others stand in a row before it and want to go in.
TEST(GiveWay, WhenThreeStandInARow_ThenBothWhoFaceTheFirstOneBackOutOneBehindTheOther) {
  MissionProblem problem = aisle();
  wall(problem, 0, 0, 8, 24);
  send(problem, "out", {12, 6, kEast}, {36, 20, kNorth});
  send(problem, "in", {20, 6, kWest}, {12, 6, kWest});
  send(problem, "behind", {26, 6, kWest}, {18, 6, kWest});
  EXPECT_EQ(planned(problem, moving(1)).verdict, Verdict::Infeasible);
  const FleetAnswer answer = planned(problem, moving(3));
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  EXPECT_EQ(answer.gave_way.size(), 2U);
  for (const GaveWay& move : answer.gave_way) EXPECT_NE(move.vehicle, 0U);
  expect_sound(problem, answer.plan);
  expect_all_arrive(problem, answer.plan);
}

// A vehicle that is lost is an obstacle: it closes the way out of the aisle behind one of the two.
TEST(GiveWay, WhenALostVehicleStandsBehindOneOfThem_ThenTheOtherGivesWay) {
  MissionProblem problem = aisle();
  wall(problem, 0, 0, 8, 3);
  send(problem, "eastbound", {16, 6, kEast}, {36, 18, kNorth});
  send(problem, "westbound", {24, 6, kWest}, {13.6, 6, kWest});
  wall(problem, 7.0, 4.6, 11.0, 7.0);
  const FleetAnswer answer = planned(problem, moving(1));
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  ASSERT_EQ(answer.gave_way.size(), 1U);
  EXPECT_EQ(problem.vehicles[answer.gave_way[0].vehicle].name, "westbound");
  expect_sound(problem, answer.plan);
}

TEST(GiveWay, WhenThereIsNoRoomAnywhere_ThenTheReasonSaysSo) {
  MissionProblem problem = face_to_face(4.0);
  problem.locations[0].pose = {36, 6, kEast};
  problem.locations[1].pose = {4, 6, kWest};
  wall(problem, 0, 0, 8, 4);
  wall(problem, 0, 8, 8, 24);
  wall(problem, 32, 0, 40, 4);
  wall(problem, 32, 8, 40, 24);
  const FleetAnswer answer = planned(problem, moving(2));
  EXPECT_EQ(answer.verdict, Verdict::Infeasible);
  EXPECT_TRUE(answer.gave_way.empty());
  EXPECT_THAT(answer.reason, HasSubstr("eastbound finds no place where it is in nobody's way"));
  EXPECT_THAT(answer.reason, HasSubstr("westbound finds no place where it is in nobody's way"));
}

// A load that it has aboard, and what is bound to it, stay with it.
TEST(GiveWay, WhenWhoGivesWayHasStopsToMake_ThenItMakesThemAllBehindThat) {
  MissionProblem problem = aisle();
  const auto west = add_vehicle(problem, "loaded", {22, 6, kWest});
  const auto here = add_location(problem, "aboard loaded", {22, 6, kWest});
  const auto rack = add_location(problem, "rack", {4, 10, kNorth}, 5s);
  problem.goals.push_back({.name = "drum", .from = here, .to = rack, .vehicle = west, .key = "goals[0]"});
  problem.vehicles[west].route = {{.pick_up = true, .goal = 0, .amount = 1},
                                  {.pick_up = false, .goal = 0, .amount = 1}};
  send(problem, "eastbound", {12, 6, kEast}, {36, 18, kNorth});
  problem.constraints.push_back({.name = "drum last",
                                 .from = {Moment::TaskEnd, 0},
                                 .to = {Moment::GoalEnd, 0},
                                 .distance = {0ms, 300s},
                                 .key = "constraints[0]"});
  // The other one has no room: behind it there is the rack and nothing else.
  wall(problem, 0, 0, 8, 4);
  wall(problem, 0, 14, 8, 24);
  const FleetAnswer answer = planned(problem, moving(1));
  ASSERT_EQ(answer.verdict, Verdict::Scheduled) << answer.reason;
  ASSERT_EQ(answer.gave_way.size(), 1U);
  const auto& stops = answer.plan.missions[west].stops;
  ASSERT_EQ(answer.gave_way[0].vehicle, west);
  ASSERT_EQ(stops.size(), 3U);
  EXPECT_EQ(stops[0].kind, StopKind::PickUp);
  EXPECT_EQ(stops[1].kind, StopKind::GiveWay);
  EXPECT_EQ(stops[1].aboard, 1U);
  EXPECT_EQ(stops[2].kind, StopKind::SetDown);
  expect_sound(problem, answer.plan);
}

}  // namespace
}  // namespace stepwright::fleet
