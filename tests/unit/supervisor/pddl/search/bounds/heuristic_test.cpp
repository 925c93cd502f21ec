#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/lifted_state.h"
#include "supervisor/pddl/plan/simulate.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/search/bounds/lower_bounds.h"
#include "supervisor/pddl/search/relaxation/additive_heuristic.h"
#include "supervisor/pddl/search/relaxation/relaxed_plan.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

GroundTask ground_all(const Task& task) {
  return ground_task(task.definition(), [] { return false; });
}

// Giving half costs ten as long as nothing more was paid, and nothing after that; filling the jar costs two.
Task order_task() {
  return testing::make_task(
      R"((define (domain order) (:requirements :strips :numeric-fluents)
    (:predicates (given))
    (:functions (jar) (paid) (bill))
    (:action fill :parameters () :precondition (<= (jar) 3) :effect (and (increase (jar) 1) (increase (bill) 1)))
    (:action pay :parameters () :precondition (<= (paid) 3) :effect (and (increase (paid) 1) (increase (bill) 3)))
    (:action all :parameters () :precondition (>= (jar) 2) :effect (given))
    (:action half :parameters () :effect (and (given) (increase (bill) (* 5 (- 4 (paid))))))))",
      R"((define (problem p) (:domain order) (:init (= (jar) 0) (= (paid) 2) (= (bill) 0)) (:goal (given))
    (:metric minimize (bill))))");
}

TEST(AdditiveHeuristic, WhenACostDependsOnTheState_ThenTheRelaxedPlanSeesWhatItCostsNow) {
  const Task task = order_task();
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const auto uses = [&](AdditiveHeuristic& heuristic, const std::string& action) {
    EXPECT_TRUE(heuristic.evaluate(space.initial().data()));
    const auto& plan = heuristic.plan();
    return std::any_of(plan.begin(), plan.end(), [&](const auto& use) {
      return model::to_string(action_of(ground, ground.operators[static_cast<std::size_t>(use.op)])) ==
             action;
    });
  };
  AdditiveHeuristic steps(relaxed, unit_weights(ground)), costs(relaxed, cost_weights(ground));
  EXPECT_TRUE(uses(steps, "(half)"));
  EXPECT_TRUE(uses(costs, "(all)"));
  EXPECT_TRUE(uses(costs, "(fill)"));
  EXPECT_FALSE(uses(costs, "(half)"));
}

TEST(AdditiveHeuristic, WhenAimedAtANumber_ThenItCountsTheStepsToIt) {
  const Task task = testing::counter_task("(>= (n) 50)");
  const GroundTask ground = ground_all(task);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  AdditiveHeuristic heuristic(relaxed, unit_weights(ground));
  heuristic.aim({}, {{{{{0, 1.0}}, -12.0, {}}, Relation::GreaterEqual}});
  ASSERT_TRUE(heuristic.evaluate(space.initial().data()));
  EXPECT_EQ(heuristic.estimate(), 4);
  heuristic.aim({}, {{{{{0, 1.0}}, 1.0, {}}, Relation::Equal}});  // n = -1: nothing counts down
  EXPECT_FALSE(heuristic.evaluate(space.initial().data()));
  heuristic.aim(relaxed.goal(), {});
  ASSERT_TRUE(heuristic.evaluate(space.initial().data()));
  EXPECT_EQ(heuristic.estimate(), 17);
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
