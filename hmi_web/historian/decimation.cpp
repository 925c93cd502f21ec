#include <algorithm>
#include <limits>

#include "hmi_web/historian/visitors.h"

namespace stepwright::historian {
namespace {

std::uint64_t distance(std::int64_t from, std::int64_t to) {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

}  // namespace

bool WindowVisitor::outside(const Summary& summary) const {
  return summary.last.time_ns < window_.from_ns || summary.first.time_ns > window_.to_ns;
}

bool WindowVisitor::inside(const Sample& sample) const {
  return sample.time_ns >= window_.from_ns && sample.time_ns <= window_.to_ns;
}

void WindowVisitor::note_before(const Sample& sample) {
  if (sample.time_ns < window_.from_ns && (!before || sample.time_ns >= before->time_ns)) before = sample;
}

void WindowVisitor::damaged(const Summary& summary) {
  damage.push_back({summary.count, summary.first.time_ns, summary.last.time_ns});
}

Look RangeVisitor::judge(const Summary& summary) {
  if (truncated) return Look::End;
  return outside(summary) ? Look::Summary : Look::Closer;
}

void RangeVisitor::take(const Summary& summary) {
  note_before(summary.last);
}

void RangeVisitor::take(const Sample& sample) {
  note_before(sample);
  if (!inside(sample)) return;
  if (samples.size() == most_) {
    truncated = true;
    return;
  }
  samples.push_back(sample);
}

TrendVisitor::TrendVisitor(Window window, std::size_t count) : WindowVisitor(window) {
  const std::uint64_t last = distance(window.from_ns, window.to_ns);
  // Every time of the window has a bucket; in windows of more than 292 years the last one may be longer.
  constexpr std::uint64_t kLongest = std::numeric_limits<std::int64_t>::max();
  bucket_ns_ = std::min(last / count, kLongest - 1) + 1;
  buckets.resize(std::min(count, static_cast<std::size_t>(last / bucket_ns_) + 1));
}

std::size_t TrendVisitor::bucket_of(std::int64_t time_ns) const {
  const std::uint64_t bucket = distance(window_.from_ns, time_ns) / bucket_ns_;
  return std::min(static_cast<std::size_t>(bucket), buckets.size() - 1);
}

Look TrendVisitor::judge(const Summary& summary) {
  if (outside(summary)) return Look::Summary;
  const bool whole = inside(summary.first) && inside(summary.last) &&
                     bucket_of(summary.first.time_ns) == bucket_of(summary.last.time_ns);
  return whole ? Look::Summary : Look::Closer;
}

void TrendVisitor::take(const Summary& summary) {
  if (outside(summary)) {
    note_before(summary.last);
  } else {
    buckets[bucket_of(summary.first.time_ns)].add(summary);
  }
}

void TrendVisitor::take(const Sample& sample) {
  note_before(sample);
  if (inside(sample)) buckets[bucket_of(sample.time_ns)].add(sample);
}

}  // namespace stepwright::historian
