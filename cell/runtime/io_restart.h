#pragma once

// Decision when the runtime starts a program again by itself that has lost its I/O: the configuration asks
// for it, the I/O has been there for as long as it says, and it did not happen too often. Nobody else has
// decided anything meanwhile: a stop, a start, another program or a supervisor take the decision away.
//
// Threads: one. No clock of its own.

#include <chrono>
#include <cstdint>
#include <deque>

#include "cell/config/restart_config.h"

namespace stepwright::cell_runtime {

class IoRestart {
 public:
  using Clock = std::chrono::steady_clock;

  explicit IoRestart(const config::RestartConfig& config) : config_(config) {}

  // The program has ended because its I/O was lost.
  void lost();
  // A person, another program or a supervisor has decided what goes on.
  void decided() { waits_ = false; }
  // True once when the program is to be started. `alive`: the I/O is there now.
  bool due(bool alive, Clock::time_point now);

  // A start is still to come.
  bool waits() const { return waits_; }
  // It would be time, but it was done too often.
  bool exhausted() const { return exhausted_; }
  // Starts within the last hour, the newest included.
  std::size_t starts() const { return starts_.size(); }

 private:
  config::RestartConfig config_;
  bool waits_ = false;
  bool exhausted_ = false;
  bool there_ = false;
  Clock::time_point there_since_{};
  std::deque<Clock::time_point> starts_;
};

}  // namespace stepwright::cell_runtime
