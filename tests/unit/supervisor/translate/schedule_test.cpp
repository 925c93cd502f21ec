#include "supervisor/translate/schedule.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

TEST(Schedule, WhenActionsAreOrdered_ThenEachStartsWhenTheLastBeforeItEnds) {
  const Binding binding = testing::bench_binding();
  const auto run = testing::bench_run({"(load v1 f1 level8)", "(move v1 f1 a1)"});
  const auto made = schedule(run, binding, false);
  ASSERT_TRUE(made);
  EXPECT_DOUBLE_EQ(made->actions[0].start_s, 1.5);
  EXPECT_DOUBLE_EQ(made->actions[0].finish_s, 1.5 + 0.4 + 8 * 1.3 + 1.5);
  EXPECT_DOUBLE_EQ(made->actions[1].start_s, made->actions[0].finish_s);
  EXPECT_DOUBLE_EQ(made->actions[1].finish_s, made->actions[1].start_s + 0.5 + 4.1);
  EXPECT_DOUBLE_EQ(made->makespan_s, made->actions[1].finish_s + 2.0);
}

TEST(Schedule, WhenPlanHasParallelParts_ThenItIsShorterThanTheSequence) {
  const Binding binding = testing::bench_binding();
  const auto run = testing::bench_run(testing::metric_ff_plan());
  const auto parallel = schedule(run, binding, false);
  const auto sequential = schedule(run, binding, true);
  ASSERT_TRUE(parallel && sequential);
  EXPECT_LT(parallel->makespan_s, 0.9 * sequential->makespan_s);
  double sum = 1.5 + 2.0;
  for (const ScheduledAction& action : sequential->actions) sum += action.finish_s - action.start_s;
  EXPECT_NEAR(sequential->makespan_s, sum, 1e-9);
  for (const model::Ordering& edge : *run.orderings) {
    EXPECT_LE(parallel->actions[edge.before].finish_s, parallel->actions[edge.after].start_s);
  }
}

TEST(Schedule, WhenTheCountedFluentIsUnknown_ThenFails) {
  const Binding binding = testing::bench_binding();
  auto run = testing::bench_run({"(move v1 f1 a1)"});
  run.actions[0].before.fluents.erase("(distance f1 a1)");
  const auto made = schedule(run, binding, false);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "T0003");
}

}  // namespace
}  // namespace stepwright::translate
