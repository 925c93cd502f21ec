#include "plant_models/core/counter_random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stepwright::core {
namespace {

constexpr int kSamples = 200'000;

TEST(CounterRandom, WhenReadInAnyOrder_ThenSameCounterGivesSameNumber) {
  const CounterRandom random(42, 3);
  const std::uint64_t late = random.bits(1'000'000);
  EXPECT_NE(random.bits(0), random.bits(1));
  EXPECT_EQ(late, random.bits(1'000'000));
  EXPECT_EQ(late, CounterRandom(42, 3).bits(1'000'000));
}

TEST(CounterRandom, WhenSeedOrStreamDiffers_ThenNumbersDiffer) {
  EXPECT_NE(CounterRandom(1, 0).bits(5), CounterRandom(2, 0).bits(5));
  EXPECT_NE(CounterRandom(1, 0).bits(5), CounterRandom(1, 1).bits(5));
}

TEST(CounterRandom, WhenEven_ThenMeanAndSpreadFit) {
  const CounterRandom random(7, 0);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = random.symmetric(static_cast<std::uint64_t>(i));
    ASSERT_GE(x, -1.0);
    ASSERT_LT(x, 1.0);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kSamples, 0.0, 0.006);  // 4.6 standard errors
  EXPECT_NEAR(squares / kSamples, 1.0 / 3.0, 0.004);
}

// Counters that follow each other by 1 and by a scan interval must look unrelated.
TEST(CounterRandom, WhenNormal_ThenStandardisedAndUncorrelated) {
  for (const std::uint64_t stride : {std::uint64_t{1}, std::uint64_t{10'000'000}}) {
    const CounterRandom random(7, 1);
    double sum = 0.0, squares = 0.0, neighbours = 0.0, before = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const double x = random.normal(static_cast<std::uint64_t>(i) * stride);
      ASSERT_LT(std::abs(x), 3.47);
      sum += x;
      squares += x * x;
      neighbours += x * before;
      before = x;
    }
    EXPECT_NEAR(sum / kSamples, 0.0, 0.01);
    EXPECT_NEAR(squares / kSamples, 1.0, 0.015);
    EXPECT_NEAR(neighbours / kSamples, 0.0, 0.01);
  }
}

}  // namespace
}  // namespace stepwright::core
