#include "plant_models/ode/subnormals.h"

#include <gtest/gtest.h>

#include <limits>

namespace stepwright::ode {
namespace {

TEST(Subnormals, WhenTheyAreFlushed_ThenTheyAreZeroUntilTheScopeEnds) {
  volatile double least = std::numeric_limits<double>::min();
  {
    const SubnormalsFlushed outer;
    EXPECT_EQ(least / 4.0, 0.0);
    {
      const SubnormalsFlushed inner;
      EXPECT_EQ(least / 4.0, 0.0);
    }
    EXPECT_EQ(least / 4.0, 0.0);
  }
  EXPECT_GT(least / 4.0, 0.0);
}

}  // namespace
}  // namespace stepwright::ode
