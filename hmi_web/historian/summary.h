#pragma once

// Summary of many samples of one tag: their number, times, extremes, first and last. Summaries of neighbours
// merge into the summary of both; that is how 30 days are drawn without reading them.
//
// Plain values; any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "hmi_web/historian/sample.h"

namespace stepwright::historian {

struct Summary {
  std::uint64_t count = 0;
  std::uint64_t unusable = 0;  // of them: bad or missing, or NaN
  Sample first, last;          // by time; meaningless while count is 0
  Sample least{0, std::numeric_limits<double>::infinity(), Quality::Good};      // of the usable ones;
  Sample greatest{0, -std::numeric_limits<double>::infinity(), Quality::Good};  // the earliest of equals

  bool has_extremes() const { return count > unusable; }
  // Samples and summaries may come in any order of time.
  void add(const Sample& sample);
  void add(const Summary& other);

  friend bool operator==(const Summary&, const Summary&) = default;
};

Summary summary_of(std::span<const Sample> samples);

// Fixed size, little-endian, with a checksum (hmi_web/doc/history_format.md).
inline constexpr std::size_t kSummaryBytes = 1 + 2 * 8 + 4 * (8 + 8 + 1) + 4;
std::array<std::byte, kSummaryBytes> encode(const Summary& summary);
std::optional<Summary> decode_summary(std::span<const std::byte> bytes);

}  // namespace stepwright::historian
