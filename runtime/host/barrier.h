#pragma once

// The barrier of simulated time: whether the clock stands still after a step change until its event is
// acknowledged, so that a supervisor's decision acts at that instant, however long it takes.
//
// The loss of the supervisor ends a barrier where the configuration says `continue` and the simulation has a
// speed. Without a speed it does not: nothing is late in such a simulation, and a supervisor that the machine
// has delayed for a moment must not lose the rest of the run. The clock then stands until a supervisor is
// there or the program is stopped.
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
