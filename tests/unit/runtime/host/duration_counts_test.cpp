#include "runtime/host/duration_counts.h"

#include <gtest/gtest.h>

#include <random>

namespace stepwright::host {
namespace {

TEST(DurationCounts, WhenNothingWasRecorded_ThenThereAreNone) {
  EXPECT_EQ(counts_of({}), DurationCounts{});
}

TEST(DurationCounts, WhenDurationsWereRecorded_ThenEachLiesBetweenTheEndsOfItsBucket) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 2'000; ++run) {
    const auto ns = static_cast<std::int64_t>(random() >> (24 + random() % 40));
    scan::Histogram durations;
    durations.record(ns);
    const DurationCounts counts = counts_of(durations);
    ASSERT_EQ(counts.counts, std::vector<std::uint64_t>{1}) << ns;
    const double us = static_cast<double>(ns) / 1'000.0;
    EXPECT_LE(count_begin_us(counts.first), us);
    EXPECT_LT(us, count_begin_us(counts.first + 1));
  }
}

TEST(DurationCounts, WhenDurationsLieApart_ThenEveryOneIsCountedAndTheEmptyOnesBetweenAreKept) {
  scan::Histogram durations;
  for (int i = 0; i < 90; ++i) durations.record(1'000);
  for (int i = 0; i < 10; ++i) durations.record(1'000'000);
  const DurationCounts counts = counts_of(durations);
  ASSERT_GT(counts.counts.size(), 2u);
  EXPECT_EQ(counts.counts.front(), 90u);
  EXPECT_EQ(counts.counts.back(), 10u);
  for (std::size_t i = 1; i + 1 < counts.counts.size(); ++i) EXPECT_EQ(counts.counts[i], 0u);
}

TEST(DurationCounts, WhenADurationIsBeyondTheRange_ThenItIsInTheLastBucket) {
  scan::Histogram durations;
  durations.record(std::int64_t{1} << 60);
  const DurationCounts counts = counts_of(durations);
  EXPECT_EQ(counts.first + counts.counts.size(), kMaxDurationCounts);
}

TEST(DurationCounts, WhenBucketsFollowEachOther_ThenTheyGrowByHalfOrThird) {
  EXPECT_EQ(count_begin_us(0), 0.0);
  for (std::uint32_t i = 2; i < kMaxDurationCounts; ++i) {
    const double ratio = count_begin_us(i + 1) / count_begin_us(i);
    EXPECT_TRUE(ratio > 1.3 && ratio < 2.01) << i << ": " << ratio;
  }
}

}  // namespace
}  // namespace stepwright::host
