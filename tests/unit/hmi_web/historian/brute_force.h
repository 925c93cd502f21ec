#pragma once

// Reference of the historian's readers, made by looking at every sample; and samples that are drawn by a
// seed.
//
// Pure functions.

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "hmi_web/historian/historian.h"

namespace stepwright::historian {

// About a sample a second, with now and then a bad one.
inline std::vector<Sample> random_walk(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> step(0.0, 1.0);
  std::vector<Sample> samples;
  double value = 0.0;
  std::int64_t time = 0;
  for (std::size_t i = 0; i < count; ++i) {
    time += 900'000'000 + static_cast<std::int64_t>(random() % 200) * 1'000'000;
    value += std::round(step(random) * 100.0) / 100.0;
    samples.push_back({time, value, random() % 1000 == 0 ? Quality::Bad : Quality::Good});
  }
  return samples;
}

inline std::vector<Sample> within(const std::vector<Sample>& samples, Window window) {
  std::vector<Sample> found;
  for (const Sample& sample : samples)
    if (sample.time_ns >= window.from_ns && sample.time_ns <= window.to_ns) found.push_back(sample);
  return found;
}

inline std::vector<Summary> buckets_of(const std::vector<Sample>& samples, Window window,
                                       const Trend& trend) {
  std::vector<Summary> buckets(trend.buckets.size());
  for (const Sample& sample : within(samples, window))
    buckets.at(static_cast<std::size_t>((sample.time_ns - window.from_ns) / trend.bucket_ns)).add(sample);
  return buckets;
}

}  // namespace stepwright::historian
