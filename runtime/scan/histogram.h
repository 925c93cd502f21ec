#pragma once

// Histogram of durations, in fixed memory: log-linear buckets in the manner of HdrHistogram (32 per power of
// two), so that percentiles are right to 1/32 from one nanosecond to 18 minutes. The extremes are exact.
// Where memory is scarce the whole program is built with fewer of them: STEPWRIGHT_HISTOGRAM_BITS = 1 makes 2
// per power of two.
// Thread rule: one writer; readers copy it between two scans.

#include <array>
#include <cstdint>

#ifndef STEPWRIGHT_HISTOGRAM_BITS
#define STEPWRIGHT_HISTOGRAM_BITS 5
#endif

namespace stepwright::scan {

class Histogram {
 public:
  // Counts one duration; a negative one as 0, one beyond the range in the last bucket.
  void record(std::int64_t duration_ns);

  // Counts everything that `other` has counted.
  void add(const Histogram& other);

  // The upper edge of the bucket that holds the `per_100000`-th of 100000 parts, never above the maximum:
  // 50000 is the median, 99900 the 99.9th percentile. 0 if nothing was recorded.
  std::int64_t percentile_ns(std::uint32_t per_100000) const;

  // For drawing: how many durations lie in bucket `index`, and the longest that does.
  static constexpr std::uint32_t bucket_count() { return kBuckets; }
  std::uint32_t bucket(std::uint32_t index) const { return buckets_[index]; }
  static std::int64_t bucket_edge_ns(std::uint32_t index);

  std::uint64_t count() const { return count_; }
  std::int64_t max_ns() const { return max_ns_; }
  void clear() { *this = Histogram(); }

 private:
  static constexpr std::uint32_t kBitsPerOctave = STEPWRIGHT_HISTOGRAM_BITS;
  static constexpr std::uint32_t kRangeBits = 40;
  static constexpr std::uint32_t kBuckets =
      ((kRangeBits - kBitsPerOctave - 1) << kBitsPerOctave) + (2u << kBitsPerOctave);

  std::array<std::uint32_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace stepwright::scan
