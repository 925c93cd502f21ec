#include "plant_models/assemblies/level_sensor.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

constexpr std::int64_t kDriftKnotNs = 3'600'000'000'000;

}  // namespace

LevelSensor::LevelSensor(const LevelCalibration& calibration, const SensorUncertainty& uncertainty,
                         std::uint64_t seed, std::uint64_t stream)
    : calibration_(calibration),
      uncertainty_(uncertainty),
      drift_(seed, 3 * stream + 1),
      noise_(seed, 3 * stream + 2),
      bias_points_(uncertainty.bias_points * core::CounterRandom(seed, 3 * stream).symmetric(0)) {}

double LevelSensor::drift_points(std::chrono::nanoseconds time) const {
  const auto knot = static_cast<std::uint64_t>(time.count() / kDriftKnotNs);
  const double u = static_cast<double>(time.count() % kDriftKnotNs) / static_cast<double>(kDriftKnotNs);
  const double from = drift_.symmetric(knot);
  const double to = drift_.symmetric(knot + 1);
  // A cubic with level ends joins the random values: smooth, bounded by them, and free of libm.
  return uncertainty_.drift_points * (from + (to - from) * u * u * (3.0 - 2.0 * u));
}

double LevelSensor::offset_points(std::chrono::nanoseconds time) const {
  return bias_points_ + drift_points(time);
}

std::int16_t LevelSensor::counts(double percent, std::chrono::nanoseconds time, double extra_counts) const {
  const double noise = uncertainty_.noise_points * noise_.normal(static_cast<std::uint64_t>(time.count()));
  const double error_points = offset_points(time) + noise;
  const double exact =
      calibration_.counts(percent) + error_points * calibration_.counts_per_percent() + extra_counts;
  return static_cast<std::int16_t>(std::floor(std::clamp(exact, -32768.0, 32767.0) + 0.5));
}

}  // namespace stepwright::assemblies
