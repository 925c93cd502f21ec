#include "supervisor/pddl/search/portfolio/fresh_starts.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// What a quick attempt finds, and what comes of it when others have had so many states.
struct Costs {
  double first = kInfinity, best = kInfinity;
  std::vector<int> plan;
};

Costs costs_after(const Task& task, std::uint64_t states) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  Costs costs;
  if (LazySearch(relaxed, control, {}).run(2000, reason) != SearchStatus::Found) return costs;
  costs.first = control.best().quality.cost;
  FreshStarts starts(relaxed, control, landmarks);
  for (std::uint64_t done = 0; done < states; done += 50) EXPECT_TRUE(starts.run(50, reason));
  costs.best = control.best().quality.cost;
  costs.plan = control.best().operators;
  EXPECT_EQ(cost_of_plan(space, costs.plan), costs.best);
  return costs;
}

TEST(FreshStarts, WhenTheFirstPlanIsADearOne_ThenACheaperOneIsFoundWithoutIt) {
  const Costs costs = costs_after(testing::bench_task(), 3000);
  EXPECT_LT(costs.first, kInfinity);
  EXPECT_LT(costs.best, 0.8 * costs.first);
}

TEST(FreshStarts, WhenRunTwice_ThenTheSamePlan) {
  const Task task = testing::bench_task("_load");
  EXPECT_EQ(costs_after(task, 1000).plan, costs_after(task, 1000).plan);
}

TEST(FreshStarts, WhenTheFirstSearchesHaveEnded_ThenClimbsFollowOneAnother) {
  const Task task = testing::logistics_task(4);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  FreshStarts starts(relaxed, control, landmarks);
  EXPECT_TRUE(starts.run(5000, reason));
  EXPECT_TRUE(starts.climbing_at_random());
  const std::uint64_t before = control.expanded();
  EXPECT_TRUE(starts.run(500, reason));
  EXPECT_GT(control.expanded(), before + 100);
  control.finish();
  EXPECT_FALSE(starts.run(500, reason));
  EXPECT_EQ(reason, StopReason::Finished);
}

TEST(FreshStarts, WhenTasksAreRandom_ThenNoPlanBecomesDearer) {
  int better = 0;
  for (std::uint32_t seed = 900; seed < 960; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    const Costs costs = costs_after(random.task, 500);
    EXPECT_LE(costs.best, costs.first);
    if (costs.best < costs.first) ++better;
  }
  EXPECT_GT(better, 0);
}

}  // namespace
}  // namespace stepwright::pddl
