#include "supervisor/pddl/search/engines/hill_climbing.h"

#include <gtest/gtest.h>

#include <set>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

struct Climb {
  SearchStatus status = SearchStatus::Running;
  Incumbent best;
  double cost = kInfinity;  // of the best plan, executed
};

Climb climb(const Task& task, std::uint64_t evaluations = 20'000, const ClimbingOptions& options = {}) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  HillClimbing climbing(relaxed, control, options);
  Climb result;
  // In small pieces: it must go on where it stopped.
  for (std::uint64_t done = 0; done < evaluations && result.status == SearchStatus::Running; done += 7) {
    result.status = climbing.run(7, reason);
  }
  result.best = control.best();
  if (result.best.quality.found()) result.cost = cost_of_plan(space, result.best.operators);
  return result;
}

// A boat that must go far one way and then far the other: every step towards one buoy leads away from the
// other.
Task buoys() {
  return testing::make_task(
      R"((define (domain buoys) (:requirements :typing :numeric-fluents :negative-preconditions)
    (:types buoy)
    (:predicates (seen ?b - buoy))
    (:functions (x) (y) (bx ?b - buoy) (by ?b - buoy))
    (:action east :parameters () :effect (increase (x) 1))
    (:action west :parameters () :effect (decrease (x) 1))
    (:action north :parameters () :effect (increase (y) 1.5))
    (:action south :parameters () :effect (decrease (y) 1.5))
    (:action see :parameters (?b - buoy)
      :precondition (and (not (seen ?b)) (<= (- (x) (bx ?b)) 1) (>= (- (x) (bx ?b)) -1)
                         (<= (- (y) (by ?b)) 1) (>= (- (y) (by ?b)) -1))
      :effect (seen ?b))))",
      R"((define (problem four) (:domain buoys) (:objects a b c d - buoy)
    (:init (= (x) 0) (= (y) 0) (= (bx a) 20) (= (by a) 4) (= (bx b) -20) (= (by b) 4)
           (= (bx c) 3) (= (by c) -30) (= (bx d) 2) (= (by d) 25))
    (:goal (and (seen a) (seen b) (seen c) (seen d)))))");
}

TEST(HillClimbing, WhenNumbersHaveNoEndAndGoalsAreFarApart_ThenItFindsAPlan) {
  const Climb result = climb(buoys());
  EXPECT_EQ(result.status, SearchStatus::Found);
  EXPECT_LT(result.cost, 250.0);
  EXPECT_GT(result.best.operators.size(), 100u);
}

TEST(HillClimbing, WhenThereAreOnlyFacts_ThenItFindsAPlan) {
  const Climb result = climb(testing::logistics_task(6));
  EXPECT_EQ(result.status, SearchStatus::Found);
  EXPECT_LT(result.cost, kInfinity);
}

// One dear step or three cheap ones.
TEST(HillClimbing, WhenItMindsCosts_ThenItTakesTheCheapWay) {
  const Task task = testing::make_task(
      R"((define (domain ways) (:requirements :strips :numeric-fluents) (:predicates (a) (b) (there)) (:functions (cost))
    (:action fly :parameters () :effect (and (there) (increase (cost) 50)))
    (:action walk-a :parameters () :effect (and (a) (increase (cost) 2)))
    (:action walk-b :parameters () :precondition (a) :effect (and (b) (increase (cost) 2)))
    (:action walk :parameters () :precondition (b) :effect (and (there) (increase (cost) 2)))))",
      "(define (problem p) (:domain ways) (:init (= (cost) 0)) (:goal (there)) (:metric minimize (cost)))");
  EXPECT_EQ(climb(task).cost, 50.0);
  EXPECT_EQ(climb(task, 100, {.costs = true}).cost, 6.0);
}

// Relaxed plans go back and forth between the buoys at once: what they begin with lets the boat stand still.
TEST(HillClimbing, WhenEveryOperatorIsTried_ThenItCrossesWhereHelpfulOnesDoNot) {
  EXPECT_EQ(climb(buoys(), 3000, {.costs = true, .all = true}).status, SearchStatus::Found);
}

TEST(HillClimbing, WhenTheOrderIsAnother_ThenThePlansDifferAndComeAgain) {
  const Task task = testing::bench_task();
  std::set<std::vector<int>> plans;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const Climb once = climb(task, 3000, {.costs = true, .seed = seed});
    EXPECT_EQ(climb(task, 3000, {.costs = true, .seed = seed}).best.operators, once.best.operators);
    if (once.status == SearchStatus::Found) plans.insert(once.best.operators);
  }
  EXPECT_GT(plans.size(), 3u);
}

TEST(HillClimbing, WhenAPlanIsKnown_ThenNoWayThatCostsAsMuchIsFollowed) {
  const Task task = buoys();
  const Climb before = climb(task);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  control.offer(std::vector<int>(20, 0), 20.0);
  HillClimbing climbing(relaxed, control);
  EXPECT_EQ(climbing.run(20'000, reason), SearchStatus::Exhausted);
  EXPECT_FALSE(climbing.arrived());
  EXPECT_GT(before.best.operators.size(), 20u);
}

TEST(HillClimbing, WhenNothingLeadsOn_ThenItEnds) {
  // Of the two doors one shuts the other for ever, and the relaxation does not tell which.
  const Task task = testing::make_task(
      R"((define (domain doors) (:requirements :strips :negative-preconditions) (:predicates (left) (right) (a) (b))
    (:action left :parameters () :precondition (not (right)) :effect (and (left) (a)))
    (:action right :parameters () :precondition (not (left)) :effect (and (right) (b)))))",
      "(define (problem p) (:domain doors) (:init) (:goal (and (a) (b))))");
  const Climb result = climb(task);
  EXPECT_EQ(result.status, SearchStatus::Exhausted);
  EXPECT_FALSE(result.best.quality.found());
}

TEST(HillClimbing, WhenTasksAreRandom_ThenWhatItFindsArePlans) {
  int found = 0;
  for (std::uint32_t seed = 500; seed < 560; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    const Climb result = climb(random.task, 3000);
    if (result.status != SearchStatus::Found) continue;
    ++found;
    EXPECT_LT(result.cost, kInfinity);
  }
  EXPECT_GT(found, 10);
}

TEST(HillClimbing, WhenTheControlSaysStop_ThenItStops) {
  const Task task = buoys();
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  control.finish();
  StopReason reason = StopReason::None;
  EXPECT_EQ(HillClimbing(relaxed, control).run(100, reason), SearchStatus::Stopped);
  EXPECT_EQ(reason, StopReason::Finished);
}

}  // namespace
}  // namespace stepwright::pddl
