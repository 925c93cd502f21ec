#include "runtime/host/pace.h"

#include <gtest/gtest.h>

namespace stepwright::host {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TEST(Pace, WhenThereIsNoSpeed_ThenNoScanWaits) {
  Pace pace(0.0);
  pace.begin(5 * kMs, 0, 10 * kMs);
  EXPECT_LE(pace.wait_ns(5 * kMs, 1'000 * kMs), 0);
}

TEST(Pace, WhenAScanIsAhead_ThenItWaitsForItsShareOfTheWallsTime) {
  Pace pace(5.0);
  pace.begin(100 * kMs, 0, 10 * kMs);
  EXPECT_EQ(pace.wait_ns(100 * kMs, 10 * kMs), 0);
  EXPECT_EQ(pace.wait_ns(101 * kMs, 60 * kMs), 9 * kMs);
}

TEST(Pace, WhenALagIsShort_ThenItIsCaughtUpAndALongOneIsNot) {
  Pace pace(1.0);
  pace.begin(0, 0, 0);
  EXPECT_EQ(pace.wait_ns(90 * kMs, 10 * kMs), -80 * kMs);
  EXPECT_EQ(pace.wait_ns(90 * kMs, 100 * kMs), 10 * kMs);  // even with the wall again
  EXPECT_EQ(pace.wait_ns(500 * kMs, 110 * kMs), -390 * kMs);
  EXPECT_EQ(pace.wait_ns(500 * kMs, 120 * kMs), 10 * kMs);  // from where it is now
}

TEST(Pace, WhenStretchesEnd_ThenTheTimeBetweenThemDoesNotCount) {
  Pace pace(0.0);
  EXPECT_FALSE(pace.factor(7 * kMs, 0));
  pace.begin(0, 0, 0);
  EXPECT_EQ(pace.factor(10 * kMs, 30 * kMs), 3.0);
  pace.end(10 * kMs, 30 * kMs);
  pace.end(99 * kMs, 30 * kMs);
  EXPECT_EQ(pace.factor(99 * kMs, 30 * kMs), 3.0);
  pace.begin(100 * kMs, 30 * kMs, 30 * kMs);
  EXPECT_EQ(pace.factor(110 * kMs, 40 * kMs), 2.0);
}

}  // namespace
}  // namespace stepwright::host
