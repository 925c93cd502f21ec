#pragma once

// Histograms in the coarse form in which they travel: two buckets for a doubling, from 16 ns to 18 minutes.
//
//   const DurationCounts counts = counts_of(timing.execution);
//   // Durations from there up to count_begin_us(counts.first + 1).
//   draw(count_begin_us(counts.first), counts.counts[0]);
//
// Pure; any thread.

#include <cstddef>
#include <cstdint>

#include "runtime/host/messages.h"
#include "runtime/scan/histogram.h"

namespace stepwright::host {

inline constexpr std::uint32_t kMaxDurationCounts = 72;

DurationCounts counts_of(const scan::Histogram& durations);

// The shortest duration of a bucket; of the number behind the last one, the end of the range.
double count_begin_us(std::uint32_t bucket);

}  // namespace stepwright::host
