#include "runtime/scan/histogram.h"

#include <bit>
#include <limits>

namespace stepwright::scan {

void Histogram::record(std::int64_t duration_ns) {
  constexpr auto kLargest = (std::uint64_t{1} << kRangeBits) - 1;
  auto value = static_cast<std::uint64_t>(duration_ns < 0 ? 0 : duration_ns);
  if (static_cast<std::int64_t>(value) > max_ns_) max_ns_ = static_cast<std::int64_t>(value);
  if (value > kLargest) value = kLargest;
  const auto width = static_cast<std::uint32_t>(std::bit_width(value));
  const std::uint32_t shift = width > kBitsPerOctave + 1 ? width - kBitsPerOctave - 1 : 0;
  std::uint32_t& bucket = buckets_[(shift << kBitsPerOctave) + static_cast<std::uint32_t>(value >> shift)];
  if (bucket < std::numeric_limits<std::uint32_t>::max()) ++bucket;
  ++count_;
}

void Histogram::add(const Histogram& other) {
  constexpr std::uint32_t kFull = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t i = 0; i < kBuckets; ++i) {
    const std::uint32_t room = kFull - buckets_[i];
    buckets_[i] += other.buckets_[i] < room ? other.buckets_[i] : room;
  }
  count_ += other.count_;
  if (other.max_ns_ > max_ns_) max_ns_ = other.max_ns_;
}

std::int64_t Histogram::percentile_ns(std::uint32_t per_100000) const {
  if (count_ == 0) return 0;
  std::uint64_t total = 0;
  for (const std::uint32_t bucket : buckets_) total += bucket;
  // Split, so that the product does not overflow; at least one value lies at or below the answer.
  std::uint64_t wanted = total / 100000 * per_100000 + (total % 100000 * per_100000 + 99999) / 100000;
  if (wanted == 0) wanted = 1;

  std::uint64_t seen = 0;
  std::uint32_t i = 0;
  while (i + 1 < kBuckets && (seen += buckets_[i]) < wanted) ++i;
  const std::int64_t upper = bucket_edge_ns(i);
  return upper < max_ns_ ? upper : max_ns_;
}

std::int64_t Histogram::bucket_edge_ns(std::uint32_t index) {
  const std::uint32_t octave = index >> kBitsPerOctave;
  const std::uint32_t shift = octave == 0 ? 0 : octave - 1;
  const std::uint64_t mantissa = index - (shift << kBitsPerOctave);
  return static_cast<std::int64_t>(((mantissa + 1) << shift) - 1);
}

}  // namespace stepwright::scan
