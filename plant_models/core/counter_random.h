#pragma once

// Random numbers as a pure function of (seed, stream, counter): the n-th number needs no number before it,
// so that a sensor may be read at any time, in any order, and a replay sees the same noise. Integer
// arithmetic and exact scaling only: the same bits on every machine. Not for secrets.

#include <cstdint>

#include "runtime/base/hash64.h"

namespace stepwright::core {

class CounterRandom {
 public:
  // Streams of the same seed are independent of each other.
  constexpr CounterRandom(std::uint64_t seed, std::uint64_t stream)
      : key_(base::hash_mix(base::hash_mix(0x5357'504C'414E'5421ull, seed), stream)) {}

  // 64 evenly distributed bits. Two rounds, because one leaves neighbouring counters correlated.
  constexpr std::uint64_t bits(std::uint64_t counter) const {
    return base::hash_mix(base::hash_mix(key_, counter), 0xA076'1D64'78BD'642Full);
  }

  // Even over [-1, 1).
  constexpr double symmetric(std::uint64_t counter) const {
    const auto top = static_cast<std::int64_t>(bits(counter)) >> 11;
    return static_cast<double>(top) * 0x1p-52;
  }

  // Nearly normal, mean 0, standard deviation 1, never beyond +-3.47: the sum of four even numbers of 16
  // bits. No logarithm or cosine is involved, which differ between C libraries in the last bit.
  constexpr double normal(std::uint64_t counter) const {
    constexpr double kMean = 4 * 32767.5;
    constexpr double kDeviation = 37837.22723720648;  // sqrt(4 * (65536^2 - 1) / 12)
    const std::uint64_t word = bits(counter);
    const std::uint64_t sum = (word & 0xFFFF) + (word >> 16 & 0xFFFF) + (word >> 32 & 0xFFFF) + (word >> 48);
    return (static_cast<double>(sum) - kMean) / kDeviation;
  }

 private:
  std::uint64_t key_;
};

}  // namespace stepwright::core
