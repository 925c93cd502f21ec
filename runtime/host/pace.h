#pragma once

// Pace of simulated time: the wait before a scan for a simulation with a speed, and how much faster or slower
// than the wall's clock the scans were altogether.
//
//   Pace pace(config.speed);
//   pace.begin(wall_ns, scan_ns, next_ns);                    // a start, or the end of a barrier
//   if (auto wait = pace.wait_ns(wall_ns, next_ns); wait > 0) sleep(wait);
//   pace.end(wall_ns, scan_ns);                               // a stop, a barrier, a person who steps
//
// Threads: the one that scans. No heap. Times in ns.

#include <cstdint>
#include <optional>

namespace stepwright::host {

class Pace {
 public:
  // Times real time; 0: as fast as possible.
  explicit Pace(double speed) : speed_(speed) {}

  // A stretch of running begins: wall and scan clock are even at the scan at `next_ns`.
  void begin(std::int64_t wall_ns, std::int64_t scan_ns, std::int64_t next_ns);
  void end(std::int64_t wall_ns, std::int64_t scan_ns);

  // Without a speed no scan waits, and nobody needs to look at the clock.
  bool keeps_step() const { return speed_ > 0.0; }
  // How long the scan at `next_ns` has to wait yet. What the simulation lags behind more than 100 ms is not
  // caught up.
  std::int64_t wait_ns(std::int64_t wall_ns, std::int64_t next_ns);

  // Scan-clock seconds per second over all stretches. None before any time has passed.
  std::optional<double> factor(std::int64_t wall_ns, std::int64_t scan_ns) const;

 private:
  double speed_;
  std::int64_t even_wall_ns_ = 0;
  std::int64_t even_scan_ns_ = 0;
  bool running_ = false;
  std::int64_t began_wall_ns_ = 0;  // of the present stretch
  std::int64_t began_scan_ns_ = 0;
  std::int64_t ran_wall_ns_ = 0;  // sums over the stretches that ended
  std::int64_t ran_scan_ns_ = 0;
};

}  // namespace stepwright::host
