// The bench's optima, found again without the planner.

#include "tests/support/pddl/exhaustive.h"

#include <gtest/gtest.h>

#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl::testing {
namespace {

TEST(Exhaustive, WhenTheBenchIsEnumerated_ThenItsOptimumIs108In17Steps) {
  const auto optimum = exhaustive_optimum(bench_task(), 300000);
  ASSERT_TRUE(optimum.has_value());
  EXPECT_EQ(optimum->cost, 108.0);
  EXPECT_EQ(optimum->steps, 17u);
}

TEST(Exhaustive, WhenTheLoadVariantIsEnumerated_ThenItsOptimumIs139In19Steps) {
  const auto optimum = exhaustive_optimum(bench_task("_load"), 300000);
  ASSERT_TRUE(optimum.has_value());
  EXPECT_EQ(optimum->cost, 139.0);
  EXPECT_EQ(optimum->steps, 19u);
}

TEST(Exhaustive, WhenNoPlanExists_ThenNothing) {
  EXPECT_FALSE(exhaustive_optimum(counter_task("(= (n) 200)"), 1000).has_value());
}

}  // namespace
}  // namespace stepwright::pddl::testing
