#pragma once

// Van der Corput's sequence in any base; Halton's takes one base for each number of a point (Kuipers,
// Niederreiter 2005). Pure; any thread.
//
//   radical_inverse(3, 2)          // 0.75: 0, 1/2, 1/4, 3/4, ...

#include <cstdint>

namespace stepwright::geometry {

// Number k of the sequence in this base, from 0 on; in [0, 1).
constexpr double radical_inverse(std::uint64_t k, std::uint64_t base) {
  double value = 0.0, weight = 1.0;
  for (; k > 0; k /= base) {
    weight /= static_cast<double>(base);
    value += weight * static_cast<double>(k % base);
  }
  return value;
}

}  // namespace stepwright::geometry
