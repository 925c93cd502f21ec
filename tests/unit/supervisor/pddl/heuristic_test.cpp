#include <gtest/gtest.h>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/lifted_state.h"
#include "supervisor/pddl/search/lower_bounds.h"
#include "supervisor/pddl/search/relaxed_plan.h"
#include "supervisor/pddl/simulate.h"
#include "supervisor/pddl/solve.h"
#include "tests/unit/supervisor/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

GroundTask ground_all(const Task& task) {
  return ground_task(task.definition(), [] { return false; });
}

TEST(RelaxedPlan, WhenTheGoalHolds_ThenZero) {
  const Task task = testing::counter_task("(>= (n) 0)");
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  RelaxedPlan heuristic(space);
  ASSERT_TRUE(heuristic.evaluate(space.initial().data()));
  EXPECT_EQ(heuristic.steps(), 0);
}

TEST(RelaxedPlan, WhenANumberIsFar_ThenItsStepsAreCounted) {
  const Task task = testing::counter_task("(>= (n) 12)");
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  RelaxedPlan heuristic(space);
  ASSERT_TRUE(heuristic.evaluate(space.initial().data()));
  EXPECT_GE(heuristic.steps(), 4);
  EXPECT_LE(heuristic.steps(), 12);
  EXPECT_FALSE(heuristic.helpful().empty());
}

TEST(RelaxedPlan, WhenDeletesAreAllThatIsIgnored_ThenTheLogisticsEstimateIsExactEnough) {
  const Task task = testing::logistics_task(5);
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  RelaxedPlan heuristic(space);
  ASSERT_TRUE(heuristic.evaluate(space.initial().data()));
  EXPECT_EQ(heuristic.steps(), 8);  // four drives, two loads, two unloads
}

TEST(RelaxedPlan, WhenAStateIsADeadEnd_ThenItSaysSo) {
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :strips :numeric-fluents) (:functions (fuel) (way))
    (:action go :parameters () :precondition (>= (fuel) 1) :effect (and (decrease (fuel) 1) (increase (way) 1)))
    (:action waste :parameters () :precondition (>= (fuel) 1) :effect (decrease (fuel) 1))))",
      R"((define (problem p) (:domain d) (:init (= (fuel) 3) (= (way) 0))
    (:goal (= (way) 3))))");
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  RelaxedPlan heuristic(space);
  std::vector<Word> state = space.initial();
  EXPECT_TRUE(heuristic.evaluate(state.data()));
  for (std::size_t v = 0; v < ground.variables.size(); ++v) {
    if (fluent_name(task.definition(), ground.variables[v]) == "(fuel)") state[v] = std::bit_cast<Word>(0.0);
  }
  EXPECT_FALSE(heuristic.evaluate(state.data()));
}

// On every state of an optimal plan, the bounds must not exceed what the rest of the plan really takes.
void expect_admissible_along_optimum(const Task& task) {
  Options options;
  options.optimal = true;
  const model::Outcome outcome = solve(task, options);
  ASSERT_TRUE(outcome.plan.has_value());
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  const LowerBounds bounds(space, [] { return false; });
  std::vector<Word> state = space.initial();
  std::vector<Word> next(state.size());
  double spent = 0.0;
  const std::size_t steps = outcome.plan->actions.size();
  for (std::size_t i = 0; i <= steps; ++i) {
    const LowerBound bound = bounds(state.data());
    EXPECT_LE(bound.cost, outcome.plan->cost - spent + 1e-9) << i;
    EXPECT_LE(bound.steps, steps - i) << i;
    if (i == steps) break;
    for (const GroundOperator& op : ground.operators) {
      if (action_of(ground, op) == outcome.plan->actions[i])
        space.apply(op, state.data(), next.data(), spent);
    }
    state = next;
  }
}

TEST(LowerBounds, WhenAlongTheBenchsOptimum_ThenNeverTooHigh) {
  expect_admissible_along_optimum(testing::bench_task());
  expect_admissible_along_optimum(testing::bench_task("_load"));
}

TEST(LowerBounds, WhenAlongOtherOptima_ThenNeverTooHigh) {
  expect_admissible_along_optimum(testing::logistics_task(4));
  expect_admissible_along_optimum(testing::counter_task("(= (n) 10)"));
  expect_admissible_along_optimum(testing::lamps_task("(and (forall (?l - lamp) (on ?l)) (powered))"));
}

TEST(LowerBounds, WhenTheBenchStarts_ThenTheUnavoidablePostponementIsSeen) {
  const Task task = testing::bench_task();
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  const LowerBounds bounds(space, [] { return false; });
  // Two of the ten units of c2 cannot be delivered at once.
  EXPECT_GE(bounds(space.initial().data()).cost, 100.0);
}

}  // namespace
}  // namespace stepwright::pddl
