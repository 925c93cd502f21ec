// Two threads: the same optimum, the memory bound over both, prompt cancelling.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "supervisor/pddl/solve.h"
#include "supervisor/pddl/validate.h"
#include "tests/unit/supervisor/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using model::OutcomeKind;
using namespace std::chrono_literals;

bool valid(const Task& task, const model::Plan& plan) {
  PlanText text;
  text.actions = plan.actions;
  text.lines.assign(plan.actions.size(), 0);
  return validate(task, text).valid;
}

// Items of three kinds move along a line of stations, one by one: a plan is plain to see, but their ways mix
// in far more states than can be searched.
Task line(int stations, int items) {
  std::string functions, actions, init, goal;
  for (const std::string kind : {"a", "b", "c"}) {
    for (int i = 0; i < stations; ++i) {
      const std::string here = "(" + kind + std::to_string(i) + ")";
      functions += here;
      init += "(= " + here + " " + std::to_string(i == 0 ? items : 0) + ")";
      if (i + 1 == stations) {
        goal += "(= " + here + " " + std::to_string(items) + ")";
        continue;
      }
      const std::string next = "(" + kind + std::to_string(i + 1) + ")";
      actions += "(:action move-" + kind + std::to_string(i) + " :parameters () :precondition (>= " + here +
                 " 1) :effect (and (decrease " + here + " 1) (increase " + next + " 1) (increase (cost) 2)))";
    }
  }
  return testing::make_task("(define (domain d) (:requirements :numeric-fluents) (:functions (cost) " +
                                functions + ")" + actions + ")",
                            "(define (problem p) (:domain d) (:init (= (cost) 0) " + init + ") (:goal (and " +
                                goal + ")) (:metric minimize (cost)))");
}

TEST(Portfolio, WhenOnTwoThreads_ThenTheBenchsOptimumIsProvedToo) {
  for (int i = 0; i < 5; ++i) {
    const Task task = testing::bench_task(i % 2 == 0 ? "" : "_load");
    Options options;
    options.threads = 2;
    const model::Outcome outcome = solve(task, options);
    ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
    EXPECT_TRUE(outcome.plan->proved_optimal);
    EXPECT_EQ(outcome.plan->cost, i % 2 == 0 ? 108.0 : 139.0);
    EXPECT_EQ(outcome.plan->actions.size(), i % 2 == 0 ? 17u : 19u);
    EXPECT_TRUE(valid(task, *outcome.plan));
  }
}

TEST(Portfolio, WhenOnTwoThreads_ThenImprovementsComeOneAtATimeAndFall) {
  std::atomic<int> inside{0};
  std::vector<double> costs;
  Options options;
  options.threads = 2;
  options.on_improvement = [&](const model::Plan& plan) {
    EXPECT_EQ(inside.fetch_add(1), 0);
    costs.push_back(plan.cost);
    inside.fetch_sub(1);
  };
  const model::Outcome outcome = solve(testing::bench_task(), options);
  ASSERT_TRUE(outcome.plan.has_value());
  ASSERT_FALSE(costs.empty());
  for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_LE(costs[i], costs[i - 1]);
  EXPECT_EQ(costs.back(), outcome.plan->cost);
}

class MemoryBound : public ::testing::TestWithParam<unsigned> {};

TEST_P(MemoryBound, WhenItIsReached_ThenTheBestPlanIsKeptAndTheBoundRespected) {
  const Task task = line(6, 12);
  Options options;
  options.threads = GetParam();
  options.budget.memory_mb = 8;
  options.budget.time = 60s;
  const model::Outcome outcome = solve(task, options);
  ASSERT_EQ(outcome.kind, OutcomeKind::Exhausted);
  EXPECT_NE(outcome.reason.find("memory"), std::string::npos) << outcome.reason;
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_TRUE(valid(task, *outcome.plan));
  EXPECT_FALSE(outcome.plan->proved_optimal);
  EXPECT_LE(outcome.plan->bound, outcome.plan->cost);
  EXPECT_LT(outcome.peak_mb, 12.0);
}

TEST_P(MemoryBound, WhenCancelledFromOutside_ThenItStopsSoonWithItsPlan) {
  const Task task = line(6, 12);
  std::atomic<bool> cancel{false};
  Options options;
  options.threads = GetParam();
  options.cancel = &cancel;
  std::chrono::steady_clock::time_point asked;
  std::thread user([&] {
    std::this_thread::sleep_for(300ms);
    asked = std::chrono::steady_clock::now();
    cancel = true;
  });
  const model::Outcome outcome = solve(task, options);
  const auto took = std::chrono::steady_clock::now() - asked;
  user.join();
  EXPECT_EQ(outcome.kind, OutcomeKind::Cancelled);
  ASSERT_TRUE(outcome.plan.has_value());
  // 50 ms on a machine that has nothing else to do.
  EXPECT_LT(took, 500ms);
}

INSTANTIATE_TEST_SUITE_P(Threads, MemoryBound, ::testing::Values(1u, 2u));

}  // namespace
}  // namespace stepwright::pddl
