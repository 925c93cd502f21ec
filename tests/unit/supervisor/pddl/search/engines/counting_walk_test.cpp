#include "supervisor/pddl/search/engines/counting_walk.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

struct Walk {
  SearchStatus status = SearchStatus::Running;
  double cost = kInfinity;  // of the plan, executed
  std::uint64_t programs = 0;
};

Walk walk(const Task& task) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  CountingWalk walk(relaxed, control);
  Walk result;
  while (result.status == SearchStatus::Running && control.expanded() < 50) {
    result.status = walk.run(1, reason);
  }
  result.programs = control.expanded();
  if (control.best().quality.found()) result.cost = cost_of_plan(space, control.best().operators);
  return result;
}

// Every counter is to be less than the next one, and most are far from that: what brings one pair into order
// brings another out of it.
TEST(CountingWalk, WhenNumbersDependOnEachOtherInAChain_ThenOneProgramGivesThePlan) {
  std::string objects, init, goal;
  const std::vector<int> values = {40, 33, 35, 12, 28, 5, 19, 7, 30, 2};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string name = "c" + std::to_string(i);
    objects += name + " ";
    init += "(= (value " + name + ") " + std::to_string(values[i]) + ")";
    if (i > 0) goal += "(<= (+ (value c" + std::to_string(i - 1) + ") 1) (value " + name + "))";
  }
  const Walk result = walk(testing::make_task(
      R"((define (domain counters) (:requirements :typing :numeric-fluents) (:types counter)
    (:functions (value ?c - counter))
    (:action up :parameters (?c - counter) :precondition (<= (value ?c) 59) :effect (increase (value ?c) 1))
    (:action down :parameters (?c - counter) :precondition (>= (value ?c) 1) :effect (decrease (value ?c) 1))))",
      "(define (problem p) (:domain counters) (:objects " + objects + "- counter) (:init " + init +
          ") (:goal (and " + goal + ")))"));
  EXPECT_EQ(result.status, SearchStatus::Found);
  EXPECT_EQ(result.cost, 136.0);  // by dynamic programming over the last value
  EXPECT_EQ(result.programs, 1u);
}

// Some 13,000 steps, each to a state of 128 numbers: the states alone would take 13 MB.
TEST(CountingWalk, WhenThePlanIsLong_ThenItTakesLittleMemory) {
  constexpr int kCounters = 128, kLimit = 512;
  std::string objects, init = "(= (limit) " + std::to_string(kLimit) + ")", goal;
  for (int i = 0; i < kCounters; ++i) {
    const std::string name = "c" + std::to_string(i);
    objects += name + " ";
    init += "(= (value " + name + ") " + std::to_string(i * 197 % (kLimit + 1)) + ")";
    if (i > 0) goal += "(<= (+ (value c" + std::to_string(i - 1) + ") 1) (value " + name + "))";
  }
  const Task task = testing::make_task(
      R"((define (domain counters) (:requirements :typing :numeric-fluents) (:types counter)
    (:functions (value ?c - counter) (limit))
    (:action up :parameters (?c - counter) :precondition (<= (+ (value ?c) 1) (limit))
             :effect (increase (value ?c) 1))
    (:action down :parameters (?c - counter) :precondition (>= (value ?c) 1) :effect (decrease (value ?c) 1))))",
      "(define (problem p) (:domain counters) (:objects " + objects + "- counter) (:init " + init +
          ") (:goal (and " + goal + ")))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  CountingWalk walk(relaxed, control);
  StopReason reason = StopReason::None;
  ASSERT_EQ(walk.run(20, reason), SearchStatus::Found);
  const std::vector<int> plan = control.best().operators;
  EXPECT_GT(plan.size(), 8'000u);
  EXPECT_LT(control.grown(), plan.size() * space.words() * sizeof(Word) / 2);
}

TEST(CountingWalk, WhenTasksAreRandom_ThenWhatItFindsArePlans) {
  int found = 0;
  for (std::uint32_t seed = 800; seed < 860; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    const Walk result = walk(random.task);
    EXPECT_EQ(result.status == SearchStatus::Found, result.cost < kInfinity);
    if (result.status == SearchStatus::Found) ++found;
  }
  EXPECT_GT(found, 5);
}

TEST(CountingWalk, WhenTheControlSaysStop_ThenItStops) {
  const Task task = testing::counter_task("(= (n) 17)");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  control.finish();
  StopReason reason = StopReason::None;
  EXPECT_EQ(CountingWalk(relaxed, control).run(10, reason), SearchStatus::Stopped);
  EXPECT_EQ(reason, StopReason::Finished);
}

}  // namespace
}  // namespace stepwright::pddl
