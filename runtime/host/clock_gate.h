#pragma once

// When the clock of a simulation may go on, and how fast it goes: the same for scans on the host and for the
// turns of a controller behind a line. Beside the state of the program three things hold it: a barrier after
// a step change, a person who steps, and a speed. A stretch lasts from a start, or the end of a barrier, to
// whatever holds the clock next, and how much faster than the wall's clock the scans were is told of
// stretches only.
//
//   ClockGate gate(config);
//   gate.arm(command.barrier);  gate.begin(now);            // a program starts
//   while (gate.may_scan()) { scan(); if (step_changed()) gate.stand(now); }
//   gate.release(now);                                      // its event was acknowledged
//   gate.rest(now);                                         // the program stops, or is at fault
//
// Threads: the one that scans. No heap.

#include <cstdint>
#include <optional>

#include "runtime/host/barrier.h"
#include "runtime/host/host_config.h"
#include "runtime/host/pace.h"
#include "runtime/host/stepper.h"

namespace stepwright::host {

// In ns: the wall's clock, that of the scans, and the latter at the next scan.
struct ClockReading {
  std::int64_t wall_ns = 0;
  std::int64_t scan_ns = 0;
  std::int64_t next_ns = 0;
};

class ClockGate {
 public:
  explicit ClockGate(const HostConfig& config) : barrier_(config), pace_(config.speed) {}

  // With every start of a program; the stretch begins behind it.
  void arm(bool barrier) { barrier_.arm(barrier); }
  void begin(const ClockReading& now);
  // For a stop, a fault, a change of what is measured.
  void rest(const ClockReading& now);

  // After a step change, in front of its event: the clock stands if the barrier holds it.
  void stand(const ClockReading& now);
  void release(const ClockReading& now);
  bool waits_for_supervisor() const { return waits_; }
  void supervisor_is_there() { barrier_.supervisor_is_there(true); }
  // A barrier that holds no more without it is released, or not: the program stops because of it.
  void supervisor_is_lost(const ClockReading& now);
  void supervisor_is_away() { barrier_.supervisor_is_there(false); }

  // A person: so many scans more; and none of that any more, of a program that runs or not.
  void step(std::uint64_t scans, const ClockReading& now);
  void go_on(bool running, const ClockReading& now);
  // After every scan; true if it stands now because of that person.
  bool scanned() { return stepper_.scanned(); }

  bool may_scan() const { return !waits_ && stepper_.may_scan(); }
  // Without a speed no scan waits, and nobody needs to look at the wall's clock; nor while a person steps.
  bool keeps_step() const { return pace_.keeps_step() && !stepper_.on(); }
  // How long the scan at `next_ns` has to wait yet. Requires keeps_step.
  std::int64_t wait_ns(std::int64_t wall_ns, std::int64_t next_ns) { return pace_.wait_ns(wall_ns, next_ns); }
  // Scan-clock seconds per second over all stretches. None before any time has passed.
  std::optional<double> factor(std::int64_t wall_ns, std::int64_t scan_ns) const {
    return pace_.factor(wall_ns, scan_ns);
  }

 private:
  Barrier barrier_;
  Stepper stepper_;
  Pace pace_;
  bool waits_ = false;
};

}  // namespace stepwright::host
