#include "runtime/host/duration_counts.h"

#include <algorithm>
#include <array>

namespace stepwright::host {
namespace {

// Of a scan::Histogram in one of ours: whole ones, so that nothing is estimated.
constexpr std::uint32_t kFine = scan::Histogram::bucket_count() / kMaxDurationCounts;
static_assert(kFine * kMaxDurationCounts == scan::Histogram::bucket_count());

}  // namespace

DurationCounts counts_of(const scan::Histogram& durations) {
  std::array<std::uint64_t, kMaxDurationCounts> sums{};
  for (std::uint32_t i = 0; i < scan::Histogram::bucket_count(); ++i) sums[i / kFine] += durations.bucket(i);
  const auto holds = [](std::uint64_t count) { return count > 0; };
  const auto first = std::find_if(sums.begin(), sums.end(), holds);
  if (first == sums.end()) return {};
  const auto end = std::find_if(sums.rbegin(), sums.rend(), holds).base();
  return {static_cast<std::uint32_t>(first - sums.begin()), {first, end}};
}

double count_begin_us(std::uint32_t bucket) {
  constexpr double kNsPerUs = 1'000.0;
  if (bucket == 0) return 0.0;
  const std::uint32_t before = std::min(bucket, kMaxDurationCounts) * kFine - 1;
  return static_cast<double>(scan::Histogram::bucket_edge_ns(before) + 1) / kNsPerUs;
}

}  // namespace stepwright::host
