#include "plant_models/assemblies/level_sensor.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
LevelSensor::LevelSensor(const LevelCalibration& calibration, const SensorUncertainty& uncertainty,
                         std::uint64_t seed, std::uint64_t stream)
    : calibration_(calibration),
      error_(uncertainty.bias_points, uncertainty.drift_points, uncertainty.noise_points, seed, stream) {}

std::int16_t LevelSensor::counts(double percent, std::chrono::nanoseconds time, double extra_counts) const {
  const double error_points = error_.offset(time) + error_.noise(time);
  const double exact =
      calibration_.counts(percent) + error_points * calibration_.counts_per_percent() + extra_counts;
  return static_cast<std::int16_t>(std::floor(std::clamp(exact, -32768.0, 32767.0) + 0.5));
}

}  // namespace stepwright::assemblies
