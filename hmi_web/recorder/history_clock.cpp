#include "hmi_web/recorder/history_clock.h"

#include <algorithm>
#include <cstdlib>

namespace stepwright::recorder {
namespace {

constexpr std::int64_t kMicrosecond = 1'000;
// Behind what was recorded of another run: the last second of that may not have reached the file.
constexpr std::int64_t kBetweenRunsNs = 2'000'000'000;
// Real time is set now and then, and a snapshot is a little old.
constexpr std::int64_t kSameRunNs = 5'000'000'000;
// Images that have waited come together, and lag for no longer than that takes.
constexpr std::int64_t kLatenessNs = 30'000'000'000;

std::int64_t whole(std::int64_t time_ns) {
  return time_ns - time_ns % kMicrosecond;
}

}  // namespace

HistoryClock::HistoryClock(bool real_time, std::optional<KnownEpoch> known) : real_time_(real_time) {
  if (!known) return;
  begun_ = is_restored_ = true;
  epoch_ns_ = known->epoch_ns;
  newest_ns_ = scanned_ns_ = known->newest_ns;
}

bool HistoryClock::is_another_run(std::int64_t scan_ns, std::int64_t wall_ns) const {
  if (!begun_ || epoch_ns_ + scan_ns < scanned_ns_) return true;
  // Real time has gone on while no scan came, and a snapshot is a little old: the same run.
  if (epoch_ns_ + scan_ns < newest_ns_ && !real_time_) return true;
  return (is_restored_ || epoch_ns_ + scan_ns < newest_ns_) && real_time_ &&
         std::abs(wall_ns - scan_ns - epoch_ns_) > kSameRunNs;
}

void HistoryClock::follow(std::int64_t scan_ns, std::int64_t wall_ns) {
  const std::int64_t late_ns = wall_ns - epoch_ns_ - scan_ns;
  if (!real_time_ || late_ns <= kSameRunNs) {
    late_since_ns_ = 0;
    return;
  }
  const bool begins = late_since_ns_ == 0;
  if (begins) late_since_ns_ = wall_ns;
  least_late_ns_ = begins ? late_ns : std::min(least_late_ns_, late_ns);
  if (wall_ns - late_since_ns_ < kLatenessNs) return;
  epoch_ns_ += whole(least_late_ns_);
  late_since_ns_ = 0;
}

std::int64_t HistoryClock::at(std::int64_t scan_ns, std::int64_t wall_ns) {
  scan_ns = whole(scan_ns);
  if (is_another_run(scan_ns, wall_ns)) {
    // Before the first scan of all there is nothing to keep away from. Time that has passed since the last
    // one does keep away.
    const std::int64_t least = scanned_ns_ == 0 ? newest_ns_ : scanned_ns_ + kBetweenRunsNs;
    epoch_ns_ = whole(std::max({wall_ns, newest_ns_, least})) - scan_ns;
    late_since_ns_ = 0;
  } else {
    follow(scan_ns, wall_ns);
  }
  begun_ = true;
  is_restored_ = false;
  seen_wall_ns_ = wall_ns;
  scanned_ns_ = epoch_ns_ + scan_ns;
  newest_ns_ = std::max(newest_ns_, scanned_ns_);
  return newest_ns_;
}

std::int64_t HistoryClock::passed(std::int64_t wall_ns) const {
  if (seen_wall_ns_ == 0) return std::max(newest_ns_, whole(wall_ns));
  return newest_ns_ + whole(std::max<std::int64_t>(0, wall_ns - seen_wall_ns_));
}

std::int64_t HistoryClock::without_scan(std::int64_t wall_ns) {
  newest_ns_ = passed(wall_ns);
  seen_wall_ns_ = wall_ns;
  return newest_ns_;
}

}  // namespace stepwright::recorder
