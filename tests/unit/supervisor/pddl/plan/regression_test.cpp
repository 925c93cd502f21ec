#include "supervisor/pddl/plan/regression.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/plan/simulate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using testing::bench_task;

Options optimal() {
  Options options;
  options.optimal = true;
  return options;
}

TEST(Regression, WhenAmountsAreMoved_ThenTheLevelsBeforeThemAreAskedFor) {
  const Task task = *bench_task().with_goal("(and (= (level a1) 5) (= (lev v1) 2))");
  const auto goals =
      weakest_preconditions(task, {{"move", {"v1", "f1", "a1"}}, {"unload", {"v1", "a1", "level3"}}});
  ASSERT_TRUE(goals.has_value());
  ASSERT_EQ(goals->size(), 3u);
  EXPECT_EQ(*(*goals)[2], "(and (= (level a1) 5) (= (lev v1) 2))");
  EXPECT_EQ(*(*goals)[1],
            "(and (is-at v1 a1) (>= (lev v1) 5) (<= (level a1) 7) (= (level a1) 2) (= (lev v1) 5))");
  EXPECT_EQ(*(*goals)[0],
            "(and (is-at v1 f1) (>= (lev v1) 5) (<= (level a1) 7) (= (level a1) 2) (= (lev v1) 5))");
}

TEST(Regression, WhenAnActionUndoesTheGoal_ThenNoStateComesBeforeIt) {
  const Task task = *bench_task().with_goal("(is-at v1 f1)");
  const auto goals =
      weakest_preconditions(task, {{"move", {"v1", "a1", "f1"}}, {"move", {"v1", "f1", "a2"}}});
  ASSERT_TRUE(goals.has_value());
  EXPECT_FALSE((*goals)[1].has_value());
  EXPECT_FALSE((*goals)[0].has_value());
}

TEST(Regression, WhenEffectsAreConditional_ThenBothCasesLead) {
  const Task task = testing::lamps_task("(on b)");
  const auto goals = weakest_preconditions(task, {{"toggle", {"hall"}}});
  ASSERT_TRUE(goals.has_value());
  ASSERT_TRUE((*goals)[0].has_value());
  State state = task.initial();
  for (const bool lit : {false, true}) {
    state.set("(on b)", lit);
    const Task from = *task.with_initial(state);
    model::Plan plan;
    plan.actions = {{"toggle", {"hall"}}};
    const auto trace = simulate(from, plan);
    const bool reached = trace && evaluate_goal(from, trace->states.back())->front().met;
    const auto asked = evaluate_goal(*from.with_goal(*(*goals)[0]), state);
    ASSERT_TRUE(asked.has_value()) << *(*goals)[0];
    bool predicted = true;
    for (const GoalStatus& part : *asked) predicted = predicted && part.met;
    EXPECT_EQ(predicted, reached) << *(*goals)[0];
  }
}

TEST(Regression, WhenAnActionIsUnknown_ThenItFails) {
  EXPECT_FALSE(weakest_preconditions(bench_task(), {{"fly", {"v1"}}}).has_value());
}

// The optimal plan's own states meet every weakest precondition on the way.
TEST(Regression, WhenThePlanIsValid_ThenItsStatesMeetTheWeakestPreconditions) {
  const Task task = bench_task();
  const model::Plan plan = *solve(task, optimal()).plan;
  const auto goals = weakest_preconditions(task, plan.actions);
  const auto trace = simulate(task, plan);
  ASSERT_TRUE(goals && trace);
  for (std::size_t k = 0; k < goals->size(); ++k) {
    ASSERT_TRUE((*goals)[k].has_value()) << k;
    const auto asked = evaluate_goal(*task.with_goal(*(*goals)[k]), trace->states[k]);
    ASSERT_TRUE(asked.has_value());
    for (const GoalStatus& part : *asked) EXPECT_TRUE(part.met) << k << ": " << part.text;
  }
}

}  // namespace
}  // namespace stepwright::pddl
