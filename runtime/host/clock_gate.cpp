#include "runtime/host/clock_gate.h"

#include <utility>

namespace stepwright::host {

// What a person steps through says nothing about speed.
void ClockGate::begin(const ClockReading& now) {
  if (!stepper_.on()) pace_.begin(now.wall_ns, now.scan_ns, now.next_ns);
}

void ClockGate::rest(const ClockReading& now) {
  pace_.end(now.wall_ns, now.scan_ns);
  waits_ = false;
}

void ClockGate::stand(const ClockReading& now) {
  if (!barrier_.holds()) return;
  pace_.end(now.wall_ns, now.scan_ns);
  waits_ = true;
}

void ClockGate::release(const ClockReading& now) {
  if (std::exchange(waits_, false)) begin(now);
}

void ClockGate::supervisor_is_lost(const ClockReading& now) {
  supervisor_is_away();
  if (!barrier_.holds()) release(now);
}

void ClockGate::step(std::uint64_t scans, const ClockReading& now) {
  pace_.end(now.wall_ns, now.scan_ns);
  stepper_.step(scans);
}

void ClockGate::go_on(bool running, const ClockReading& now) {
  stepper_.release();
  if (running && !waits_) begin(now);
}

}  // namespace stepwright::host
