#include <gtest/gtest.h>

#include "tests/bench/arm/baselines.h"
#include "tests/bench/arm/measure.h"

namespace stepwright::bench {
namespace {

TEST(ArmBench, WhenProblemsAreOurOwn_ThenAllAreSolvedAndNoPathCollides) {
  const ProblemSet set = problems_of_our_own(4, 0.02);
  const OwnFigures own = measure_ours(set);
  EXPECT_EQ(own.problems, 4u);
  EXPECT_EQ(own.valid, 4u);
  EXPECT_EQ(own.solved, 4u);
  EXPECT_EQ(own.collisions, 0u);
  const BaselineFigures ompl = ompl_on_spheres(set, own.measured, false, 60.0);
  EXPECT_EQ(ompl.asked, own.measured.size());
  EXPECT_EQ(ompl.solved, ompl.asked);
}

}  // namespace
}  // namespace stepwright::bench
