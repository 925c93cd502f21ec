#pragma once

// Step mode of simulated time: the clock stands still and runs only as many scans as are asked for. The
// scans' results do not depend on it. A barrier holds beside it: scans that are still to run do so after its
// event was acknowledged.
//
//   stepper.step(2);
//   while (stepper.may_scan()) { run_scan(); stepper.scanned(); }     // two scans, then it stands
//
// Threads: the scan thread. No heap.

#include <cstdint>

namespace stepwright::host {

class Stepper {
 public:
  bool on() const { return on_; }
  bool may_scan() const { return !on_ || left_ > 0; }

  // Stands still after `scans` more, in place of what was left of an earlier request.
  void step(std::uint64_t scans) {
    on_ = true;
    left_ = scans;
  }
  void release() { on_ = false; }
  // Called after every scan; true if it stands now.
  bool scanned() { return on_ && (left_ == 0 || --left_ == 0); }

 private:
  bool on_ = false;
  std::uint64_t left_ = 0;
};

}  // namespace stepwright::host
