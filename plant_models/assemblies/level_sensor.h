#pragma once

// A level sensor with raw counts: a static calibration, and what makes a real one uncertain.
// counts = calibration(level) + bias(seed) + drift(seed, t) + noise(seed, t), rounded to whole counts.
// Every term is a pure function of seed and time: the same instant always gives the same reading,
// whoever asks and how often.

#include <chrono>
#include <cstdint>

#include "plant_models/core/sensor_error.h"

namespace stepwright::assemblies {

// A straight line through two calibrated points, levels in percent.
struct LevelCalibration {
  double low_percent = 0.0;
  double low_counts = 0.0;
  double high_percent = 100.0;
  double high_counts = 1000.0;

  constexpr double counts_per_percent() const {
    return (high_counts - low_counts) / (high_percent - low_percent);
  }
  constexpr double counts(double percent) const {
    return low_counts + (percent - low_percent) * counts_per_percent();
  }
};

// Sizes in percent points of level.
struct SensorUncertainty {
  double bias_points = 6.0;   // constant, even over +- this
  double drift_points = 1.0;  // stays within +- this, takes an hour from one random value to the next
  double noise_points = 1.0;  // standard deviation, white from one nanosecond to the next

  static constexpr SensorUncertainty none() { return {0.0, 0.0, 0.0}; }
};

class LevelSensor {
 public:
  // `stream` tells the sensors of one seed apart.
  LevelSensor(const LevelCalibration& calibration, const SensorUncertainty& uncertainty, std::uint64_t seed,
              std::uint64_t stream);

  // The reading of a tank at `percent`; `extra_counts` is what a fault adds. Limited to 16 bits signed.
  std::int16_t counts(double percent, std::chrono::nanoseconds time, double extra_counts = 0.0) const;

  // The slow part of the error, in percent points: what a tare removes.
  double offset_points(std::chrono::nanoseconds time) const { return error_.offset(time); }

 private:
  LevelCalibration calibration_;
  core::SensorError error_;
};

}  // namespace stepwright::assemblies
