#include <gtest/gtest.h>

#include "supervisor/ltl/planner/plan_train.h"
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

}  // namespace
}  // namespace stepwright::bench
