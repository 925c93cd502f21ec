#include "supervisor/executive/planning_job.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/plan/describe_run.h"
#include "tests/support/given_time.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using std::chrono::milliseconds;

PlanRequest request() {
  return {.start = {.planning = pddl::to_named(bench_planning().task().initial())}};
}

TEST(PlanningJob, WhenLeftAlone_ThenItsPlanIsThatOfTheService) {
  PlanningJob job(bench_planning(), request());
  while (!job.wait(milliseconds(50))) {
  }
  const auto outcome = job.take();
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->status, PrepareStatus::Ready);
  EXPECT_EQ(outcome->prepared.container, bench_planning().prepare(request())->prepared.container);
}

TEST(PlanningJob, WhenCancelledAtOnce_ThenItEndsWithoutAProofSoon) {
  const support::GivenTime given;
  {
    PlanningJob job(bench_planning(), request());
    job.cancel();
  }
  EXPECT_LT(given.ms(), 5'000.0);
}

TEST(PlanningService, WhenWhatIsLeftStillLeadsToTheGoal_ThenItIsKept) {
  auto first = bench_planning().prepare(request());
  ASSERT_TRUE(first);
  PlanRequest again = request();
  again.remaining = first->prepared.plan.actions;
  const auto kept = bench_planning().prepare(again);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->prepared.episode.origin, "kept");
  EXPECT_EQ(kept->prepared.episode.kept, again.remaining.size());
  EXPECT_EQ(kept->prepared.plan.actions, first->prepared.plan.actions);
}

TEST(PlanningService, WhenAnotherGoalIsGiven_ThenItIsPlannedForAndJudged) {
  PlanRequest other = request();
  other.start.goal = "(and (= (level a1) 3) (is-at v1 f1))";
  const auto outcome = bench_planning().prepare(other);
  ASSERT_TRUE(outcome);
  ASSERT_EQ(outcome->status, PrepareStatus::Ready);
  EXPECT_LT(outcome->prepared.plan.actions.size(), 6u);
  const auto goals =
      bench_planning().goal_status(outcome->prepared.run.actions.back().after, other.start.goal);
  ASSERT_EQ(goals.size(), 2u);
  EXPECT_TRUE(goals[0].met && goals[1].met);
  EXPECT_FALSE(bench_planning().check_goal("(= (level a9) 3)"));
}

}  // namespace
}  // namespace stepwright::executive
