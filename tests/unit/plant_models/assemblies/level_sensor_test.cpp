#include "plant_models/assemblies/level_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/bench_parameters.h"

namespace stepwright::assemblies {
namespace {

using namespace std::chrono_literals;

const BenchParameters kBench;

TEST(LevelSensor, WhenExact_ThenCountsAreThoseOfThePaper) {
  const auto reads = [](std::size_t i, double percent) {
    return LevelSensor(kBench.calibration[i], SensorUncertainty::none(), 1, i).counts(percent, 5s);
  };
  EXPECT_EQ(reads(0, 20.0), 1322);
  EXPECT_EQ(reads(0, 100.0), 3784);
  EXPECT_EQ(reads(1, 20.0), 736);
  EXPECT_EQ(reads(1, 50.0), 1854);
  EXPECT_EQ(reads(2, 20.0), 1061);
  EXPECT_EQ(reads(2, 50.0), 1773);
}

TEST(LevelSensor, WhenReadAgainAtTheSameTime_ThenSameCounts) {
  const LevelSensor sensor(kBench.calibration[0], kBench.uncertainty, 9, 0);
  const std::int16_t first = sensor.counts(40.0, 123456789ns);
  EXPECT_NE(sensor.counts(40.0, 20ms), sensor.counts(40.0, 30ms));
  EXPECT_EQ(sensor.counts(40.0, 123456789ns), first);
  EXPECT_EQ(LevelSensor(kBench.calibration[0], kBench.uncertainty, 9, 0).counts(40.0, 123456789ns), first);
}

TEST(LevelSensor, WhenSeedsVary_ThenBiasFillsItsRange) {
  SensorUncertainty bias_only = SensorUncertainty::none();
  bias_only.bias_points = 6.0;
  double lowest = 0.0, highest = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const double bias = LevelSensor(kBench.calibration[0], bias_only, seed, 0).offset_points(0s);
    lowest = std::min(lowest, bias);
    highest = std::max(highest, bias);
  }
  EXPECT_GE(lowest, -6.0);
  EXPECT_LT(lowest, -5.5);
  EXPECT_LE(highest, 6.0);
  EXPECT_GT(highest, 5.5);
}

TEST(LevelSensor, WhenHoursPass_ThenDriftStaysBoundedAndSlow) {
  SensorUncertainty drift_only = SensorUncertainty::none();
  drift_only.drift_points = 1.0;
  const LevelSensor sensor(kBench.calibration[0], drift_only, 4, 0);
  double before = sensor.offset_points(0s), lowest = before, highest = before;
  for (auto t = 10s; t < 48h; t += 10s) {
    const double now = sensor.offset_points(t);
    ASSERT_LE(std::abs(now), 1.0);
    ASSERT_LE(std::abs(now - before), 2.0 * 1.5 * 10.0 / 3600.0);  // steepest part of the cubic
    lowest = std::min(lowest, now);
    highest = std::max(highest, now);
    before = now;
  }
  EXPECT_GT(highest - lowest, 1.0);
}

TEST(LevelSensor, WhenNoiseOnly_ThenSpreadIsOnePoint) {
  SensorUncertainty noise_only = SensorUncertainty::none();
  noise_only.noise_points = 1.0;
  const LevelCalibration& calibration = kBench.calibration[0];
  const LevelSensor sensor(calibration, noise_only, 11, 0);
  constexpr int kScans = 20'000;
  double squares = 0.0;
  for (int i = 0; i < kScans; ++i) {
    const double error = sensor.counts(50.0, i * 10ms) - calibration.counts(50.0);
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / kScans) / calibration.counts_per_percent(), 1.0, 0.03);
}

TEST(LevelSensor, WhenFarOutside_ThenStopsAtTheEndsOfTheWord) {
  const LevelSensor sensor(kBench.calibration[0], SensorUncertainty::none(), 1, 0);
  EXPECT_EQ(sensor.counts(0.0, 0s, 1e9), 32767);
  EXPECT_EQ(sensor.counts(0.0, 0s, -1e9), -32768);
}

}  // namespace
}  // namespace stepwright::assemblies
