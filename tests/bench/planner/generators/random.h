#pragma once

// Random numbers that are the same on every machine: the distributions of the standard library are not.
//
// Thread rule: one stream, one thread.

#include <cstdint>
#include <utility>
#include <vector>

namespace stepwright::bench {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  // 0 .. count - 1; count > 0.
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }

  // low .. high, both included.
  int between(int low, int high) { return low + below(high - low + 1); }

  template <typename T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i) {
      std::swap(values[i - 1], values[static_cast<std::size_t>(below(static_cast<int>(i)))]);
    }
  }

 private:
  // SplitMix64 (Steele, Lea, Flood 2014).
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace stepwright::bench
