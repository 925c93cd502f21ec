#include "hmi_web/historian/suppression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace stepwright::historian {
namespace {

std::vector<Sample> kept_of(const std::vector<Sample>& samples, SuppressionSettings settings) {
  Suppression suppression(settings);
  std::vector<Sample> kept;
  for (const Sample& sample : samples)
    suppression.offer(sample, [&](const Sample& one) { kept.push_back(one); });
  if (suppression.held()) kept.push_back(*suppression.held());
  return kept;
}

// How far the line between the kept samples around it passes from a sample.
double distance_from_line(const std::vector<Sample>& kept, const Sample& sample) {
  const auto after = std::ranges::lower_bound(kept, sample.time_ns, {}, &Sample::time_ns);
  if (after->time_ns == sample.time_ns) return std::abs(after->value - sample.value);
  const Sample& before = *(after - 1);
  const double share = static_cast<double>(sample.time_ns - before.time_ns) /
                       static_cast<double>(after->time_ns - before.time_ns);
  return std::abs(before.value + share * (after->value - before.value) - sample.value);
}

TEST(Suppression, WhenAValueRepeats_ThenOnlyItsChangesAreKept) {
  const std::vector<Sample> samples = {{0, 1}, {1, 1}, {2, 1}, {3, 2}, {4, 2}, {5, 1}};
  EXPECT_EQ(kept_of(samples, {}), (std::vector<Sample>{{0, 1}, {3, 2}, {5, 1}}));
}

TEST(Suppression, WhenTheQualityChanges_ThenTheSampleIsKept) {
  const std::vector<Sample> samples = {{0, 1}, {1, 1, Quality::Missing}, {2, 1, Quality::Missing}, {3, 1}};
  const std::vector<Sample> expected = {{0, 1}, {1, 1, Quality::Missing}, {3, 1}};
  EXPECT_EQ(kept_of(samples, {}), expected);
  EXPECT_EQ(kept_of(samples, {SuppressionKind::SwingingDoor, 5.0}), samples) << "the end of a line, too";
}

TEST(Suppression, WhenNothingChangesForLong_ThenASampleIsKeptNow) {
  std::vector<Sample> samples;
  for (std::int64_t t = 0; t <= 100; ++t) samples.push_back({t, 1.0});
  SuppressionSettings settings;
  settings.longest_gap_ns = 30;
  EXPECT_EQ(kept_of(samples, settings), (std::vector<Sample>{{0, 1}, {30, 1}, {60, 1}, {90, 1}}));
}

TEST(Suppression, WhenItIsOff_ThenEverySampleIsKept) {
  const std::vector<Sample> samples = {{0, 1}, {1, 1}, {1, 1}, {2, 1}};
  EXPECT_EQ(kept_of(samples, {SuppressionKind::None}), samples);
}

TEST(Suppression, WhenASampleComesLate_ThenItIsKept) {
  const std::vector<Sample> samples = {{10, 1}, {5, 1}, {11, 1}};
  EXPECT_EQ(kept_of(samples, {}), (std::vector<Sample>{{10, 1}, {5, 1}}));
}

TEST(SwingingDoor, WhenValuesLieOnALine_ThenItsEndsAreKept) {
  std::vector<Sample> samples;
  for (std::int64_t t = 0; t <= 1000; ++t) samples.push_back({t, 0.5 * static_cast<double>(t)});
  const auto kept = kept_of(samples, {SuppressionKind::SwingingDoor, 0.01});
  EXPECT_EQ(kept, (std::vector<Sample>{samples.front(), samples.back()}));
}

TEST(SwingingDoor, WhenValuesWander_ThenNoSampleIsFartherFromTheLinesThanTheDeviation) {
  std::mt19937 random(6);
  std::normal_distribution<double> step(0.0, 1.0);
  for (int round = 0; round < 100; ++round) {
    std::vector<Sample> samples;
    double value = 0.0;
    std::int64_t time = 0;
    for (int i = 0; i < 500; ++i) {
      time += 1 + static_cast<std::int64_t>(random() % 1000);
      value += step(random);
      samples.push_back({time, value});
    }
    const double deviation = 0.1 + 0.1 * round;
    const auto kept = kept_of(samples, {SuppressionKind::SwingingDoor, deviation});
    ASSERT_TRUE(std::ranges::is_sorted(kept, {}, &Sample::time_ns));
    ASSERT_EQ(kept.front(), samples.front());
    ASSERT_EQ(kept.back(), samples.back());
    for (const Sample& sample : samples) ASSERT_LE(distance_from_line(kept, sample), deviation * (1 + 1e-9));
    if (deviation >= 5.0) {
      EXPECT_LT(kept.size(), samples.size() / 4);
    }
  }
}

TEST(SwingingDoor, WhenAValueIsNoNumber_ThenItIsKept) {
  const double nan = std::nan("");
  const auto kept = kept_of({{0, 1}, {1, 1}, {2, nan}, {3, 1}}, {SuppressionKind::SwingingDoor, 1.0});
  EXPECT_EQ(kept, (std::vector<Sample>{{0, 1}, {1, 1}, {2, nan}, {3, 1}}));
}

}  // namespace
}  // namespace stepwright::historian
