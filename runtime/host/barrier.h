#pragma once

// The barrier of simulated time: whether the clock stands still after a step change until its event is
// acknowledged, so that what a supervisor decides acts at that instant, however long it takes.
//
// A supervisor that is lost lets go of it where the configuration says `continue` and the simulation keeps
// step with the wall's clock. Without a speed it does not: nothing is late in such a simulation, and a
// supervisor that the machine has held up for a moment must not cost it the rest of the run. The clock then
// stands until a supervisor is there, or somebody stops the program.
//
// Threads: the one that scans. No heap.

#include "runtime/host/host_config.h"

namespace stepwright::host {

class Barrier {
 public:
  explicit Barrier(const HostConfig& config)
      : simulated_(config.clock == ClockMode::Simulated), paced_(config.speed > 0.0) {}

  // With every start of a program.
  void arm(bool wanted) { wanted_ = wanted; }
  void supervisor_is_there(bool there) { there_ = there; }

  // Whether the clock stands still after the step change that has just been.
  bool holds() const { return wanted_ && simulated_ && (there_ || !paced_); }

 private:
  bool simulated_;
  bool paced_;
  bool wanted_ = false;
  bool there_ = true;
};

}  // namespace stepwright::host
