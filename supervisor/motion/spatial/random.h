#pragma once

// Numbers that look random and are the same for a seed on every machine (SplitMix64: Steele, Lea, Flood 2014,
// Fast splittable pseudorandom number generators). A value; one thread each.
//
//   Random random(seed);
//   const double angle_rad = random.between(-1.0, 1.0);

#include <cstddef>
#include <cstdint>

namespace stepwright::motion {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t mixed = state_ += 0x9E3779B97F4A7C15U;
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
    return mixed ^ (mixed >> 31U);
  }
  // From 0 up to, not including, 1.
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  double between(double lower, double upper) { return lower + (upper - lower) * unit(); }
  // 0 to end - 1. Requires an end above 0; bias below 2^-32 for ends below 2^32.
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(unit() * static_cast<double>(end)); }

 private:
  std::uint64_t state_;
};

}  // namespace stepwright::motion
