// Two threads: the same optimum, the memory bound over both, prompt cancelling, counted in states.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/engines/lazy_search.h"
#include "supervisor/pddl/search/portfolio/portfolio.h"
#include "tests/support/pddl/sample_tasks.h"

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

// Items of three kinds move along a line of stations, one by one or, for less, two at once: a plan is plain
// to see, but their ways mix in far more states than can be searched. With an odd number of items one goes
// alone on every stretch, which bounds do not see.
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
      for (const int count : {1, 2}) {
        const std::string amount = std::to_string(count);
        actions += "(:action move" + amount + kind + std::to_string(i) +
                   " :parameters () :precondition (>= " + here + " " + amount + ") :effect (and (decrease " +
                   here + " " + amount + ") (increase " + next + " " + amount + ") (increase (cost) " +
                   std::to_string(count + 1) + ")))";
      }
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

// The executive plans on one thread: a long proof must not keep it waiting for what is cheap to find.
TEST(Portfolio, WhenOnOneThread_ThenPlansGetBetterBeforeALongProof) {
  constexpr int kItems = 9;
  const Task task = line(5, kItems);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  std::atomic<bool> cancel{false};
  SearchControl control(60s, 0, &cancel);
  // Every item alone.
  std::vector<int> plan;
  for (std::size_t i = 0; i < ground.operators.size(); ++i) {
    const bool single = action_of(ground, ground.operators[i]).name.starts_with("move1");
    if (single) plan.insert(plan.end(), kItems, static_cast<int>(i));
  }
  ASSERT_TRUE(offer_plan(space, control, plan));
  ASSERT_EQ(control.best().quality.cost, 216.0);
  control.on_improvement = [&](const Incumbent& best) { cancel = best.quality.cost <= 168.0; };
  StopReason reason = StopReason::None;
  EXPECT_FALSE(Portfolio(relaxed, control, {}).run(reason));
  EXPECT_EQ(reason, StopReason::Cancelled);
  EXPECT_LT(control.expanded(), 1000u);
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
  const Task task = line(6, 13);
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

TEST_P(MemoryBound, WhenCancelledFromOutside_ThenItStopsWithItsPlan) {
  const Task task = line(6, 13);
  std::atomic<bool> cancel{false};
  Options options;
  options.threads = GetParam();
  options.cancel = &cancel;
  std::atomic<bool> found{false}, done{false};
  options.on_improvement = [&](const model::Plan&) { found = true; };
  std::thread user([&] {
    while (!found && !done) std::this_thread::yield();
    cancel = true;
  });
  const model::Outcome outcome = solve(task, options);
  done = true;
  user.join();
  EXPECT_EQ(outcome.kind, OutcomeKind::Cancelled);
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_TRUE(valid(task, *outcome.plan));
}

// Whenever the cancelling comes, each thread expands a few states more: as many as it does between two looks
// at the flag. What it does within one state looks at the flag too (lp_bound_test).
TEST_P(MemoryBound, WhenCancelledAmidTheProof_ThenNoThreadExpandsMoreThanAFewStates) {
  const Task task = line(6, 13);
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  for (const std::uint64_t after : {0u, 700u, 1500u}) {
    std::atomic<bool> cancel{false}, done{false};
    SearchControl control(0ms, 0, &cancel);
    StopReason reason = StopReason::None;
    ASSERT_EQ(LazySearch(relaxed, control, {}).run(10'000, reason), SearchStatus::Found);
    const std::uint64_t begin = control.expanded();
    std::uint64_t asked = 0;
    std::thread user([&] {
      while (!done && control.expanded() < begin + after) std::this_thread::yield();
      cancel = true;
      asked = control.expanded();
    });
    Portfolio portfolio(relaxed, control, {.prove_first = GetParam() == 1, .threads = GetParam()});
    EXPECT_FALSE(portfolio.run(reason));
    done = true;
    user.join();
    EXPECT_EQ(reason, StopReason::Cancelled);
    EXPECT_LE(control.expanded(), asked + 64 * GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, MemoryBound, ::testing::Values(1u, 2u));

}  // namespace
}  // namespace stepwright::pddl
