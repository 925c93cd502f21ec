#pragma once

// Error of a sensor's reading: bias(seed) + drift(seed, t) + noise(seed, t). Every term is a pure function of
// seed and time: the same instant always gives the same error, whoever asks and how often. In the unit of the
// sensor. Any thread.

#include <chrono>
#include <cstdint>

#include "plant_models/core/counter_random.h"

namespace stepwright::core {

class SensorError {
 public:
  // Constant bias, even over +-`bias`; drift within +-`drift`, which takes an hour from one random value to
  // the next; white noise of standard deviation `noise`. `stream` tells the sensors of one seed apart.
  SensorError(double bias, double drift, double noise, std::uint64_t seed, std::uint64_t stream);

  // Bias and drift: what a tare removes.
  double offset(std::chrono::nanoseconds time) const;
  // A new value every nanosecond.
  double noise(std::chrono::nanoseconds time) const;

 private:
  double drift_size_;
  double noise_size_;
  CounterRandom drift_;
  CounterRandom noise_;
  double bias_;
};

}  // namespace stepwright::core
