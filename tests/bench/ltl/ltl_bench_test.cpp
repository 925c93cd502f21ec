#include <gtest/gtest.h>

#include "supervisor/ltl/planner/plan_train.h"
#include "tests/bench/ltl/ltl_planner.h"
#include "tests/bench/ltl/train_problem.h"

namespace stepwright::bench {
namespace {

// The baseline has the same answers' judge: both searches solve the same problems, and the seed makes them.
TEST(LtlBench, WhenTheSeedIsTheSame_ThenTheProblemIsAndBothSearchesSolveIt) {
  for (const char* scene : {"blocks.geojson", "walls.geojson"}) {
    const auto floor = published_floor(scene);
    ASSERT_TRUE(floor) << scene;
    const ltl::Problem problem = train_problem(*floor, "visit p1", 2, 3);
    EXPECT_EQ(problem.start, train_problem(*floor, "visit p1", 2, 3).start);
    EXPECT_FALSE(problem.start == train_problem(*floor, "visit p1", 2, 4).start);
    for (const auto guide : {ltl::SearchGuide::OnTheRegions, ltl::SearchGuide::None})
      EXPECT_TRUE(ltl::plan_train(problem, {.most_s = 600.0, .most_rounds = 3000, .guide = guide})) << scene;
  }
}

// And so has the planner of others.
TEST(LtlBench, WhenLtlPlannerHasTime_ThenTheRefereeAcceptsItsPlan) {
  seed_ompl(1);
  ltl::Problem problem;
  problem.floor.border = {"border", {{0, 0}, {12, 0}, {12, 12}, {0, 12}}, {}};
  problem.floor.obstacles = {{"wall", {{5, 0}, {6, 0}, {6, 6}, {5, 6}}, {}}};
  problem.floor.propositions = {{"press", {{7, 6}, {11, 6}, {11, 11}, {7, 11}}, {}}};
  problem.start = {3.0, 6.0, 0.0};
  problem.task = "visit press";
  const OmplAnswer answer = plan_by_ltlplanner(problem, 0.05, 600.0);
  ASSERT_TRUE(answer.plan);
  EXPECT_TRUE(answer.judgement.accepted()) << answer.judgement.reason;
  EXPECT_EQ(answer.judgement.word.back(), ltl::Label{1});
}

}  // namespace
}  // namespace stepwright::bench
