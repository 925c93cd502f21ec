#pragma once

// Clock of all recorded data: the scan clock, placed in real time, so that the samples of all runs follow
// each other. Scan time 0 of a run has an epoch. Distances within a run are exactly those of the scan clock;
// only the first samples after a time without scans may be earlier than the last time given, and get that
// one, and a run in real time whose scans lag behind it for half a minute (real time was set forward, or no
// scan came while it passed) goes on at real time. After a run that is faster than real time the next one
// begins in the future. Invariant: time never runs backwards.
//
//   HistoryClock clock(config.clock.mode == ClockMode::Real, known);
//   const std::int64_t t = clock.at(snapshot.time_ns, wall_ns);
//
// Not thread-safe. Times are ns since 1970; epochs and scans are kept to whole microseconds.

#include <cstdint>
#include <optional>

namespace stepwright::recorder {

// Clock of an earlier process, as it was stored.
struct KnownEpoch {
  std::int64_t epoch_ns = 0;   // of the run that it saw last
  std::int64_t newest_ns = 0;  // the newest time that it gave
};

class HistoryClock {
 public:
  // `real_time`: the scan keeps to real time, so that another epoch means another run.
  explicit HistoryClock(bool real_time, std::optional<KnownEpoch> known = std::nullopt);

  // The time of a scan. One that is earlier than the scan before is of another run.
  std::int64_t at(std::int64_t scan_ns, std::int64_t wall_ns);
  // The time while no scan comes: real time goes on.
  std::int64_t without_scan(std::int64_t wall_ns);
  // What without_scan() would say. Between two runs at() leaves out more than that.
  std::int64_t passed(std::int64_t wall_ns) const;

  std::int64_t newest_ns() const { return newest_ns_; }
  std::int64_t epoch_ns() const { return epoch_ns_; }

 private:
  bool is_another_run(std::int64_t scan_ns, std::int64_t wall_ns) const;
  void follow(std::int64_t scan_ns, std::int64_t wall_ns);

  bool real_time_;
  bool begun_ = false;        // there is an epoch
  bool is_restored_ = false;  // it is that of a process before, and no scan has come yet
  std::int64_t epoch_ns_ = 0;
  std::int64_t newest_ns_ = 0;
  std::int64_t scanned_ns_ = 0;     // of the newest scan; 0: there was none
  std::int64_t late_since_ns_ = 0;  // real time since which every scan lags behind it; 0: none does
  std::int64_t least_late_ns_ = 0;  // by at least so much
  std::int64_t seen_wall_ns_ = 0;   // real time when `newest_ns_` was given; 0: not by this process
};

}  // namespace stepwright::recorder
