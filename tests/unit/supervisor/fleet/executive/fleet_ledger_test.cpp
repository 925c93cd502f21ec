#include "supervisor/fleet/executive/fleet_ledger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;

// Two trucks; three units of flour before one of sugar, which has a deadline; each truck parks.
MissionProblem two_trucks() {
  MissionProblem problem;
  problem.classes = {{.name = "forklift", .model = {}, .key = "models[0]"}};
  for (const char* name : {"truck 1", "truck 2"}) {
    MissionVehicle vehicle;
    vehicle.name = name;
    vehicle.capacity = 2;
    problem.vehicles.push_back(vehicle);
  }
  for (const char* name : {"dock", "rack", "park 1", "park 2"})
    problem.locations.push_back({.name = name, .pose = {}, .key = name});
  problem.goals = {{.name = "flour", .amount = 3, .from = 0, .to = 1, .key = "goals[0]"},
                   {.name = "sugar", .amount = 1, .from = 0, .to = 1, .key = "goals[1]"}};
  problem.tasks = {{.name = "task 1", .vehicle = 0, .location = 2, .key = "tasks[0]"},
                   {.name = "task 2", .vehicle = 1, .location = 3, .key = "tasks[1]"}};
  problem.constraints = {{.name = "deadline of sugar",
                          .from = {},
                          .to = {Moment::GoalEnd, 1},
                          .distance = {0ms, 200s},
                          .key = "goals[1].deadline_ms"},
                         {.name = "flour first",
                          .from = {Moment::GoalEnd, 0},
                          .to = {Moment::GoalEnd, 1},
                          .distance = {0ms, 100'000s},
                          .key = "constraints[0]"}};
  return problem;
}

Stop stop(StopKind kind, const std::string& goal, std::uint32_t amount) {
  Stop made;
  made.kind = kind;
  made.goal = goal;
  made.amount = amount;
  return made;
}

std::vector<NewStart> starts() {
  return {{.start = {1.0, 1.0, 0.0}}, {.start = {5.0, 1.0, 0.0}}};
}

TEST(FleetLedger, WhenNothingHasHappened_ThenTheRestIsTheProblem) {
  const FleetLedger ledger(two_trucks());
  const RestProblem rest = ledger.rest({.elapsed = 0ms, .starts = starts()});
  ASSERT_EQ(rest.problem.goals.size(), 2u);
  EXPECT_EQ(rest.problem.goals[0].amount, 3u);
  EXPECT_EQ(rest.problem.tasks.size(), 2u);
  EXPECT_EQ(rest.problem.constraints.size(), 2u);
  EXPECT_FALSE(ledger.complete());
}

TEST(FleetLedger, WhenSomethingElseIsWantedThanTheFileSays_ThenItIsOrdered) {
  FleetLedger ledger(two_trucks());
  const LedgerState before = ledger.state();
  EXPECT_FALSE(ledger.ordered());
  ASSERT_TRUE(ledger.order("flour", "dock", "rack", 4));
  EXPECT_TRUE(ledger.ordered());
  ASSERT_TRUE(ledger.restore(before));
  EXPECT_FALSE(ledger.ordered());
  ASSERT_TRUE(ledger.order("salt", "rack", "dock", 1));
  EXPECT_TRUE(ledger.ordered());
}

TEST(FleetLedger, WhenALoadIsAboard_ThenItsVehicleBeginsWithIt) {
  FleetLedger ledger(two_trucks());
  ledger.made(1, stop(StopKind::PickUp, "flour", 2), 10s);
  EXPECT_EQ(ledger.goals()[0].state(), GoalState::Carried);
  const RestProblem rest = ledger.rest({.elapsed = 20s, .starts = starts()});
  ASSERT_EQ(rest.problem.goals.size(), 3u);  // flour left, sugar, flour aboard
  EXPECT_EQ(rest.problem.goals[0].amount, 1u);
  const MissionGoal& aboard = rest.problem.goals[2];
  EXPECT_EQ(aboard.amount, 2u);
  EXPECT_EQ(aboard.vehicle, std::optional<std::size_t>(1));
  EXPECT_EQ(rest.problem.locations[aboard.from].pose, starts()[1].start);
  const MissionVehicle& carrier = rest.problem.vehicles[1];
  ASSERT_EQ(carrier.route.size(), 2u);
  EXPECT_TRUE(carrier.route[0].pick_up);
  EXPECT_FALSE(carrier.route_is_whole);
  // Sugar has to wait for both parts of the flour.
  const auto first = std::ranges::count(rest.problem.constraints, "flour first", &MissionConstraint::name);
  EXPECT_EQ(first, 2);
}

TEST(FleetLedger, WhenWhatIsAboardCannotBeBrought_ThenItTakesUpRoomAndIsNoPartOfTheRestUntilReopened) {
  FleetLedger ledger(two_trucks());
  ledger.made(1, stop(StopKind::PickUp, "flour", 1), 10s);
  EXPECT_TRUE(ledger.keep_aboard(1, 0, "no way"));
  EXPECT_FALSE(ledger.keep_aboard(1, 0, "no way")) << "that changes nothing";
  const RestProblem rest = ledger.rest({.elapsed = 20s, .starts = starts()});
  ASSERT_EQ(rest.problem.goals.size(), 2u);  // flour left, sugar
  EXPECT_EQ(rest.problem.goals[0].amount, 2u);
  EXPECT_EQ(rest.problem.vehicles[1].capacity, 1u);
  EXPECT_TRUE(rest.problem.vehicles[1].route.empty());
  FleetLedger again(two_trucks());
  ASSERT_TRUE(again.restore(ledger.state()));
  EXPECT_EQ(again.vehicles()[1].kept, std::set<std::size_t>{0});
  EXPECT_TRUE(again.reopen());
  EXPECT_EQ(again.rest({.elapsed = 20s, .starts = starts()}).problem.goals.size(), 3u);
  EXPECT_FALSE(again.reopen());
}

// Another vehicle was the last to carry some of it.
TEST(FleetLedger, WhenALostVehicleHasSomeAboard_ThenThatIsTheReasonWhyItIsMissing) {
  FleetLedger ledger(two_trucks());
  ledger.made(1, stop(StopKind::PickUp, "flour", 1), 10s);
  ledger.made(0, stop(StopKind::PickUp, "flour", 2), 11s);
  EXPECT_EQ(ledger.reason_of(0, {}), "");
  ledger.lose(1, "it does not answer");
  ledger.made(0, stop(StopKind::SetDown, "flour", 2), 30s);
  EXPECT_EQ(ledger.goals()[0].vehicle, std::optional<std::uint32_t>(0));
  EXPECT_EQ(ledger.reason_of(0, {}), "1 aboard of truck 2, which is lost");
  ledger.find(1);
  EXPECT_EQ(ledger.reason_of(0, {}), "");
  EXPECT_EQ(ledger.reason_of(0, {true, true}), "1 aboard of truck 2, which cannot leave where it stands");
  ledger.give_up(0, "no way");
  EXPECT_EQ(ledger.reason_of(0, {}), "no way");
}

TEST(FleetLedger, WhenPartsAreGivenUp_ThenItIsSaidOfEachOnlyOnce) {
  FleetLedger ledger(two_trucks());
  EXPECT_TRUE(ledger.give_up(0, "no way"));
  EXPECT_FALSE(ledger.give_up(0, "no way"));
  EXPECT_TRUE(ledger.give_up_task(1));
  EXPECT_FALSE(ledger.give_up_task(1));
}

TEST(FleetLedger, WhenAVehicleIsLost_ThenOthersGetWhatItDoesNotCarry) {
  FleetLedger ledger(two_trucks());
  ledger.made(0, stop(StopKind::PickUp, "flour", 2), 10s);
  ledger.lose(0, "does not move");
  const RestProblem rest = ledger.rest({.elapsed = 20s, .starts = starts()});
  ASSERT_EQ(rest.problem.vehicles.size(), 1u);
  EXPECT_EQ(rest.vehicles, std::vector<std::uint32_t>({1}));
  EXPECT_EQ(rest.problem.goals[0].amount, 1u);  // two units are on the lost truck
  ASSERT_EQ(rest.problem.tasks.size(), 1u);
  EXPECT_EQ(rest.problem.tasks[0].vehicle, 0u);  // truck 2 by its new number
  ledger.find(0);
  EXPECT_EQ(ledger.rest({.elapsed = 30s, .starts = starts()}).problem.vehicles.size(), 2u);
}

TEST(FleetLedger, WhenGoalsAreDelivered_ThenTheirConstraintsCountFromThen) {
  FleetLedger ledger(two_trucks());
  for (const std::uint32_t units : {2u, 1u}) {
    ledger.made(0, stop(StopKind::PickUp, "flour", units), 10s);
    ledger.made(0, stop(StopKind::SetDown, "flour", units), 40s + units * 1s);
  }
  const RestProblem rest = ledger.rest({.elapsed = 50s, .starts = starts()});
  ASSERT_EQ(rest.problem.goals.size(), 1u);
  EXPECT_EQ(rest.problem.goals[0].name, "sugar");
  ASSERT_EQ(rest.problem.constraints.size(), 1u);  // flour has come first
  EXPECT_EQ(rest.problem.constraints[0].name, "deadline of sugar");
  EXPECT_EQ(rest.problem.constraints[0].distance.most, 150s);
}

TEST(FleetLedger, WhenAStopHasBegun_ThenConstraintsCountFromItsEnd) {
  FleetLedger ledger(two_trucks());
  Stop down = stop(StopKind::SetDown, "flour", 3);
  down.service = 5s;
  ledger.made(0, stop(StopKind::PickUp, "flour", 3), 10s);
  ledger.made(0, down, 40s);
  EXPECT_EQ(ledger.goals()[0].ends, std::vector<std::chrono::milliseconds>({45s}));
  ledger.ended(down, 40s, 46s);
  EXPECT_EQ(ledger.goals()[0].ends, std::vector<std::chrono::milliseconds>({46s}));
}

TEST(FleetLedger, WhenATaskIsBehindItsVehicle_ThenConstraintsCountFromIt) {
  MissionProblem problem = two_trucks();
  problem.locations[2].service = 5s;
  problem.tasks.push_back({.name = "task 3", .vehicle = 0, .location = 3, .key = "tasks[2]"});
  problem.constraints = {{.name = "after the first drive",
                          .from = {Moment::TaskEnd, 0},
                          .to = {Moment::GoalEnd, 1},
                          .distance = {30s, 100'000s},
                          .key = "constraints[0]"}};
  FleetLedger ledger(problem);
  ledger.made(0, stop(StopKind::Park, "", 0), 10s);
  const RestProblem rest = ledger.rest({.elapsed = 20s, .starts = starts()});
  ASSERT_EQ(rest.problem.constraints.size(), 1u);
  EXPECT_EQ(rest.problem.constraints[0].from.moment, Moment::TimeZero);
  EXPECT_EQ(rest.problem.constraints[0].distance.least, 25s);  // 10 s + 5 s + 30 s - 20 s
}

TEST(FleetLedger, WhenWhatAConstraintCountsFromIsAboardOfALostVehicle_ThenItIsNamed) {
  FleetLedger ledger(two_trucks());
  ledger.made(0, stop(StopKind::PickUp, "flour", 3), 10s);
  EXPECT_TRUE(ledger.rest({.elapsed = 20s, .starts = starts()}).unbound.empty());
  ledger.lose(0, "does not move");
  const RestProblem rest = ledger.rest({.elapsed = 20s, .starts = starts()});
  EXPECT_EQ(rest.unbound, std::vector<std::string>({"flour first"}));
}

TEST(FleetLedger, WhenLimitsAreDropped_ThenOnlyOrdersRemainAndTheGoalIsLate) {
  FleetLedger ledger(two_trucks());
  EXPECT_EQ(ledger.drop_limits(), std::vector<std::string>({"deadline of sugar"}));
  EXPECT_TRUE(ledger.drop_limits().empty());
  EXPECT_TRUE(ledger.goals()[1].late);
  const RestProblem rest = ledger.rest({.elapsed = 0ms, .starts = starts()});
  ASSERT_EQ(rest.problem.constraints.size(), 1u);
  EXPECT_EQ(rest.problem.constraints[0].name, "flour first");
}

TEST(FleetLedger, WhenSomethingIsOrdered_ThenItIsAGoalOrAnotherAmountOfOne) {
  FleetLedger ledger(two_trucks());
  EXPECT_TRUE(ledger.order("salt", "rack", "dock", 1));
  EXPECT_EQ(ledger.goals().size(), 3u);
  ledger.made(0, stop(StopKind::PickUp, "flour", 2), 10s);
  EXPECT_TRUE(ledger.order("flour", "dock", "rack", 0));  // what is aboard is delivered all the same
  EXPECT_EQ(ledger.goals()[0].amount, 2u);
  struct Order {
    const char* name;
    const char* from;
    const char* to;
    std::uint32_t amount;
  };
  for (const auto& [name, from, to, amount] : {Order{"salt", "dock", "rack", 1},
                                               {"x", "nowhere", "rack", 1},
                                               {"x", "rack", "rack", 1},
                                               {"", "rack", "dock", 1},
                                               {"x", "rack", "dock", 0}}) {
    const auto refused = ledger.order(name, from, to, amount);
    ASSERT_FALSE(refused) << name << from;
    EXPECT_EQ(refused.error().front().code, "X0003");
  }
}

TEST(FleetLedger, WhenItsStateIsRestored_ThenItIsTheSame) {
  FleetLedger ledger(two_trucks());
  ASSERT_TRUE(ledger.order("salt", "rack", "dock", 1));
  ledger.made(1, stop(StopKind::PickUp, "salt", 1), 10s);
  FleetLedger again(two_trucks());
  ASSERT_TRUE(again.restore(ledger.state()));
  EXPECT_EQ(again.problem().goals.back().name, "salt");
  EXPECT_EQ(again.vehicles()[1].aboard, ledger.vehicles()[1].aboard);
  LedgerState foreign = ledger.state();
  foreign.vehicles.pop_back();
  EXPECT_FALSE(again.restore(foreign));
}

}  // namespace
}  // namespace stepwright::fleet
