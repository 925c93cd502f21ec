// Properties over random small tasks: the planner's optimum is the enumerated one, and every plan validates.

#include <gtest/gtest.h>

#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/exhaustive.h"
#include "tests/support/pddl/random_task.h"

namespace stepwright::pddl {
namespace {

class RandomTasks : public ::testing::TestWithParam<std::uint32_t> {};

// Solves every task and counts those that can be.
int judge(std::uint32_t first, std::uint32_t count, testing::RandomTask (*make)(std::uint32_t)) {
  int solvable = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const testing::RandomTask random = make(first + i);
    SCOPED_TRACE(random.domain + random.problem);
    const Task& task = random.task;
    const auto optimum = testing::exhaustive_optimum(task, 20000);
    Options options;
    options.optimal = i % 2 == 0;
    options.threads = i % 3 == 0 ? 2 : 1;
    const model::Outcome outcome = solve(task, options);
    if (!optimum) {
      EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible) << outcome.reason;
      continue;
    }
    ++solvable;
    EXPECT_EQ(outcome.kind, model::OutcomeKind::Solved) << outcome.reason;
    if (!outcome.plan) continue;
    EXPECT_EQ(outcome.plan->cost, optimum->cost);
    EXPECT_EQ(outcome.plan->actions.size(), optimum->steps);
    PlanText text;
    text.actions = outcome.plan->actions;
    text.lines.assign(text.actions.size(), 0);
    const Validation validation = validate(task, text);
    EXPECT_TRUE(validation.valid) << result::to_string(validation.diagnostics);
    EXPECT_EQ(validation.cost(), outcome.plan->cost);
  }
  return solvable;
}

TEST_P(RandomTasks, WhenSolved_ThenAsGoodAsEnumerationAndValid) {
  EXPECT_GT(judge(GetParam() * 1000, 25, testing::random_task), 3);
}

TEST_P(RandomTasks, WhenFullOfNumbers_ThenAsGoodAsEnumerationAndValid) {
  EXPECT_GT(judge(GetParam() * 1000, 20, testing::random_numeric_task), 1);
}

TEST_P(RandomTasks, WhenThingsAreMovedWithFuel_ThenAsGoodAsEnumerationAndValid) {
  EXPECT_GT(judge(GetParam() * 1000, 25, testing::random_transport_task), 3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTasks, ::testing::Range(1u, 13u));

}  // namespace
}  // namespace stepwright::pddl
