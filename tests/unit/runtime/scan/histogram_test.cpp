#include "runtime/scan/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace stepwright::scan {
namespace {

TEST(Histogram, Percentile_WhenNothingWasRecorded_ThenIsZero) {
  EXPECT_EQ(Histogram().percentile_ns(99'000), 0);
}

TEST(Histogram, Percentile_WhenValuesAreSmall_ThenIsExact) {
  Histogram histogram;
  for (std::int64_t i = 1; i <= 10; ++i) histogram.record(i);
  EXPECT_EQ(histogram.percentile_ns(50'000), 5);
  EXPECT_EQ(histogram.percentile_ns(90'000), 9);
  EXPECT_EQ(histogram.percentile_ns(100'000), 10);
  EXPECT_EQ(histogram.percentile_ns(0), 1);
}

// Sorting every value is the oracle.
TEST(Histogram, Percentile_WhenComparedWithSortedValues_ThenIsWithinOneBucket) {
  std::mt19937_64 random(7);
  std::vector<std::int64_t> values;
  Histogram histogram;
  for (int i = 0; i < 50'000; ++i) {
    values.push_back(static_cast<std::int64_t>(random() >> (24 + random() % 36)));
    histogram.record(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const std::uint32_t part : {1'000u, 50'000u, 90'000u, 99'000u, 99'900u, 99'999u}) {
    const auto exact = values[(values.size() * part + 99'999) / 100'000 - 1];
    const auto answer = histogram.percentile_ns(part);
    EXPECT_GE(answer, exact) << part;
    EXPECT_LE(answer, exact + exact / 32) << part;
  }
  EXPECT_EQ(histogram.max_ns(), values.back());
  EXPECT_EQ(histogram.count(), values.size());
}

TEST(Histogram, Record_WhenOutOfRange_ThenCountsAtTheEnds) {
  Histogram histogram;
  histogram.record(-5);
  histogram.record(INT64_MAX);
  EXPECT_EQ(histogram.percentile_ns(50'000), 0);
  EXPECT_EQ(histogram.max_ns(), INT64_MAX);
  EXPECT_GE(histogram.percentile_ns(100'000), (std::int64_t{1} << 40) - 1);
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0u);
}

}  // namespace
}  // namespace stepwright::scan
