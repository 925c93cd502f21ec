#pragma once

// One value of one tag at one time: what the historian keeps.
//
// Plain values.

#include <bit>
#include <cstdint>

#include "runtime/base/strong_id.h"

namespace stepwright::historian {

struct TagIdTag;
using TagId = base::StrongId<TagIdTag>;

enum class Quality : std::uint8_t {
  Good,
  Uncertain,  // forced, simulated or out of its range
  Bad,        // the source says that the value is wrong
  Missing,    // from here on nothing is known: the source is lost
};
inline constexpr std::uint8_t kQualities = 4;

const char* to_string(Quality quality);

// Every number of a PLC up to 2^53 is exact as a double; LINT and LWORD beyond that are rounded.
struct Sample {
  std::int64_t time_ns =
      0;  // of the scan that saw the value, on the clock that the caller chose for the file
  double value = 0.0;
  Quality quality = Quality::Good;
};

// Bit by bit, so that NaN is equal to itself and 0 is not -0.
inline bool same_value(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool operator==(const Sample& a, const Sample& b) {
  return a.time_ns == b.time_ns && same_value(a.value, b.value) && a.quality == b.quality;
}

struct TagSample {
  TagId tag;
  Sample sample;
};

}  // namespace stepwright::historian
