#include "plant_models/core/sensor_error.h"

namespace stepwright::core {
namespace {

constexpr std::int64_t kDriftKnotNs = 3'600'000'000'000;

}  // namespace

SensorError::SensorError(double bias, double drift, double noise, std::uint64_t seed, std::uint64_t stream)
    : drift_size_(drift),
      noise_size_(noise),
      drift_(seed, 3 * stream + 1),
      noise_(seed, 3 * stream + 2),
      bias_(bias * CounterRandom(seed, 3 * stream).symmetric(0)) {}

double SensorError::offset(std::chrono::nanoseconds time) const {
  const auto knot = static_cast<std::uint64_t>(time.count() / kDriftKnotNs);
  const double u = static_cast<double>(time.count() % kDriftKnotNs) / static_cast<double>(kDriftKnotNs);
  const double from = drift_.symmetric(knot);
  const double to = drift_.symmetric(knot + 1);
  // A cubic with level ends joins the random values: smooth, bounded by them, and free of libm.
  return bias_ + drift_size_ * (from + (to - from) * u * u * (3.0 - 2.0 * u));
}

double SensorError::noise(std::chrono::nanoseconds time) const {
  return noise_size_ * noise_.normal(static_cast<std::uint64_t>(time.count()));
}

}  // namespace stepwright::core
