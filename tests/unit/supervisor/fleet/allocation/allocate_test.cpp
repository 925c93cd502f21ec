#include "supervisor/fleet/allocation/allocate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/support/fleet/allocation_checker.h"
#include "tests/support/fleet/drawn_transports.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace std::chrono_literals;

// Locations in a row, 10 s from one to the next one; vehicles stand at the first.
AllocationProblem row_of(std::uint32_t locations, std::uint32_t vehicles, std::uint32_t capacity) {
  AllocationProblem problem;
  TravelTimes times(locations);
  for (std::uint32_t i = 0; i < locations; ++i) {
    problem.locations.push_back("l" + std::to_string(i));
    for (std::uint32_t j = 0; j < locations; ++j) {
      times.set(LocationId(i), LocationId(j), 10s * (i < j ? j - i : i - j));
    }
  }
  problem.classes.push_back(times);
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    problem.vehicles.push_back(
        {.name = "v" + std::to_string(v), .start = LocationId(0), .capacity = capacity});
  }
  return problem;
}

TransportId add(AllocationProblem& problem, std::uint32_t from, std::uint32_t to, std::uint32_t amount = 1) {
  const TransportId id(static_cast<std::uint32_t>(problem.transports.size()));
  problem.transports.push_back({.name = "t" + std::to_string(id.value),
                                .amount = amount,
                                .from = LocationId(from),
                                .to = LocationId(to)});
  return id;
}

TransportConstraint within(const std::string& name, TransportTimepoint from, TransportTimepoint to,
                           milliseconds most) {
  return {name, from, to, {0ms, most}};
}

TEST(Allocate, WhenTwoLoadsFitAtOnce_ThenTheyGoTogether) {
  AllocationProblem problem = row_of(4, 1, 2);
  add(problem, 1, 3);
  add(problem, 1, 3);
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.makespan, 30s);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
}

TEST(Allocate, WhenALoadIsLargerThanTheVehicle_ThenItIsMovedInSeveralTrips) {
  AllocationProblem problem = row_of(2, 1, 2);
  add(problem, 0, 1, 5);
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.figures.trips, 3U);
  EXPECT_EQ(answer.makespan, 50s);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
}

TEST(Allocate, WhenAnIndivisibleLoadIsTooLarge_ThenTheReasonSaysSo) {
  AllocationProblem problem = row_of(2, 1, 2);
  add(problem, 1, 0);
  const TransportId large = add(problem, 0, 1, 3);
  problem.transports[large.value].divisible = false;
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(answer.conflict.transports, ElementsAre(large));
  EXPECT_THAT(to_string(answer.conflict, problem), HasSubstr("'t1': 3 from 'l0' to 'l1'"));
  EXPECT_THAT(to_string(answer.conflict, problem), HasSubstr("no vehicle carries more than 2"));
}

TEST(Allocate, WhenTwoDeadlinesAreTooTightForOneVehicle_ThenBothAreBlamedAndNothingElse) {
  AllocationProblem problem = row_of(8, 1, 1);
  const TransportId left = add(problem, 0, 4), middle = add(problem, 3, 4), right = add(problem, 4, 7);
  problem.constraints = {within("middle soon", {}, end_of(middle), 500s),
                         within("left first", {}, end_of(left), 40s),
                         within("right first", {}, start_of(right), 40s)};
  problem.constraints.push_back(within("right quickly", start_of(right), end_of(right), 30s));
  problem.constraints[2].distance.most = 39s;
  AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(answer.conflict.transports, ElementsAre(right));
  EXPECT_THAT(answer.conflict.constraints, ElementsAre(2U));

  problem.constraints[2].distance.most = 40s;
  problem.constraints[1].distance.most = 50s;
  problem.transports[left.value].set_down_service = 5s;
  answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(answer.conflict.transports, ElementsAre(left, right));
  EXPECT_THAT(answer.conflict.constraints, ElementsAre(1U, 2U));
  EXPECT_TRUE(answer.conflict.minimal);
  EXPECT_THAT(to_string(answer.conflict, problem),
              HasSubstr("Constraint 'left first': the set-down of 't0' comes at least 0 s and at most 50 s "
                        "after time zero."));
}

TEST(Allocate, WhenAConstraintTiesTwoVehicles_ThenTheOneWaitsForTheOther) {
  AllocationProblem problem = row_of(10, 2, 1);
  const TransportId far = add(problem, 8, 9), near = add(problem, 1, 2);
  problem.constraints = {{"near after far", end_of(far), start_of(near), {5s, 100'000s}}};
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.makespan, 105s);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
}

TEST(Allocate, WhenALoadMustNotBeAboardForLong_ThenItIsPickedUpLater) {
  AllocationProblem problem = row_of(4, 1, 1);
  const TransportId load = add(problem, 1, 2);
  problem.constraints = {within("fresh", start_of(load), end_of(load), 10s),
                         {"not before", {}, end_of(load), {60s, 100'000s}}};
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.routes[0].stops[0].begin, 50s);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
}

TEST(Allocate, WhenAnOperatorFixesTheVehicle_ThenItTakesTheLoad) {
  AllocationProblem problem = row_of(5, 2, 1);
  problem.vehicles[1].start = LocationId(4);
  const TransportId load = add(problem, 0, 1);
  problem.transports[load.value].vehicle = VehicleId(1);
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_THAT(answer.routes[0].stops, IsEmpty());
  EXPECT_EQ(answer.makespan, 50s);
}

TEST(Allocate, WhenTheBeginningOfARouteIsFixed_ThenTheRestIsPlannedBehindIt) {
  AllocationProblem problem = row_of(6, 1, 2);
  const TransportId begun = add(problem, 5, 0), other = add(problem, 0, 1);
  problem.routes = {{VehicleId(0), {{LoadAction::PickUp, begun, 1}}, false}};
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.routes[0].stops.front().transport, begun);
  EXPECT_EQ(answer.makespan, 110s);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
  problem.routes[0].whole = true;
  const AllocationAnswer torn = allocate(problem);
  ASSERT_EQ(torn.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(torn.conflict.routes, ElementsAre(0U));
  EXPECT_THAT(to_string(torn.conflict, problem), HasSubstr("the route of vehicle 'v0'"));
  (void)other;
}

TEST(Allocate, WhenFixedPartsContradictEachOther_ThenTheyAreNamed) {
  AllocationProblem problem = row_of(3, 2, 1);
  const TransportId a = add(problem, 0, 1), b = add(problem, 1, 2);
  problem.transports[a.value].vehicle = VehicleId(0);
  problem.transports[b.value].vehicle = VehicleId(1);
  problem.orders = {{a, b}};
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(answer.conflict.vehicles, ElementsAre(a, b));
  EXPECT_THAT(answer.conflict.orders, ElementsAre(0U));
  EXPECT_THAT(to_string(answer.conflict, problem), HasSubstr("one vehicle takes 't0' before 't1'"));
}

TEST(Allocate, WhenOneOfManyTransportsIsOutOfReach_ThenItIsNamed) {
  AllocationProblem problem = row_of(5, 3, 1);
  problem.locations.push_back("island");
  TravelTimes times(6);
  for (std::uint32_t i = 0; i < 5; ++i) {
    for (std::uint32_t j = 0; j < 5; ++j) times.set(LocationId(i), LocationId(j), 10s);
  }
  problem.classes = {times};
  for (std::uint32_t t = 0; t < 40; ++t) add(problem, t % 5, (t + 2) % 5);
  const TransportId lost = add(problem, 2, 5);
  const AllocationAnswer answer = allocate(problem, {.iterations = 5});
  ASSERT_EQ(answer.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(answer.conflict.transports, ElementsAre(lost));
  EXPECT_TRUE(answer.conflict.minimal);
}

TEST(Allocate, WhenTwoOfManyTransportsExcludeEachOther_ThenBothAreNamed) {
  AllocationProblem problem = row_of(5, 3, 1);
  for (std::uint32_t t = 0; t < 40; ++t) add(problem, t % 5, (t + 2) % 5);
  const TransportId a(7), b(23);
  problem.transports[a.value].vehicle = problem.transports[b.value].vehicle = VehicleId(1);
  problem.constraints = {within("together", start_of(a), start_of(b), 5s),
                         within("and early", {}, end_of(a), 1000s)};
  const AllocationAnswer answer = allocate(problem, {.iterations = 5});
  ASSERT_EQ(answer.verdict, AllocationVerdict::Infeasible);
  EXPECT_THAT(answer.conflict.transports, ElementsAre(a, b));
  EXPECT_THAT(answer.conflict.constraints, ElementsAre(0U));
}

TEST(Allocate, WhenManyLoadsFillTheLargestVehicleOnly_ThenSmallOnesHelp) {
  AllocationProblem problem = row_of(6, 4, 1);
  problem.vehicles[0].capacity = 2;
  for (std::uint32_t t = 0; t < 14; ++t) add(problem, t % 3, 3 + t % 3, 2);
  const AllocationAnswer answer = allocate(problem, {.iterations = 200});
  ASSERT_EQ(answer.verdict, AllocationVerdict::Feasible);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
  // The largest one alone drives 30 s with each load, and 30 s back to the next one.
  EXPECT_LT(answer.makespan, 14 * 60s - 30s);
  for (const VehicleRoute& route : answer.routes) EXPECT_FALSE(route.stops.empty());
}

TEST(Allocate, WhenALoadWouldTakeAMillionTrips_ThenItIsNotTried) {
  AllocationProblem problem = row_of(2, 2, 1);
  problem.vehicles[1].capacity = 3;
  add(problem, 0, 1, 1'000'000'000);
  EXPECT_EQ(allocate(problem).verdict, AllocationVerdict::Exhausted);
  problem.transports[0].amount = 500;
  const AllocationAnswer answer = allocate(problem, {.iterations = 1});
  ASSERT_EQ(answer.verdict, AllocationVerdict::Feasible);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
}

TEST(Allocate, WhenCancelledBeforeAnythingIsKnown_ThenItSaysSo) {
  AllocationProblem problem = row_of(8, 1, 1);
  const TransportId left = add(problem, 3, 1), right = add(problem, 4, 7);
  problem.constraints = {within("left", {}, end_of(left), 60s), within("right", {}, end_of(right), 75s)};
  ASSERT_EQ(allocate(problem).verdict, AllocationVerdict::Infeasible);
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(allocate(problem, {.cancel = &cancel}).verdict, AllocationVerdict::Cancelled);
}

TEST(Allocate, WhenNodesAreFew_ThenTheAnswerIsFeasibleWithABound) {
  const AllocationProblem problem = support::draw_transports(support::TransportKind::Due, 8, 4, 1);
  const AllocationAnswer best = allocate(problem);
  ASSERT_EQ(best.verdict, AllocationVerdict::Optimal);
  const AllocationAnswer answer = allocate(problem, {.iterations = 2, .nodes = 100});
  ASSERT_EQ(answer.verdict, AllocationVerdict::Feasible);
  EXPECT_LE(answer.lower_bound, best.objective);
  EXPECT_GE(answer.objective, best.objective);
  EXPECT_GT(answer.lower_bound, 0);
}

TEST(Allocate, WhenThereIsNothingToDo_ThenVehiclesGoToTheirFinish) {
  AllocationProblem problem = row_of(4, 2, 1);
  problem.vehicles[1].finish = LocationId(3);
  const AllocationAnswer answer = allocate(problem);
  ASSERT_EQ(answer.verdict, AllocationVerdict::Optimal);
  EXPECT_EQ(answer.makespan, 30s);
  EXPECT_THAT(faults_of(answer, problem), IsEmpty());
  EXPECT_EQ(allocate(AllocationProblem{}).verdict, AllocationVerdict::Optimal);
}

}  // namespace
}  // namespace stepwright::fleet
