#pragma once

// Sees to it that a guard watches the outputs as long as the configuration wants one: starts the first, and
// another when it is gone (killed, crashed) or stands still (which is killed first, so that there are never
// two). Who looks at the log or the status is told.
//
//   GuardWatch guard(config, *io, log);
//   if (auto started = guard.start(); !started) ...
//   while (...) { guard.turn(); runtime.set_note("guard", guard.note()); }
//
// Threads: the service's. A turn does not wait.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "cell/config/cell_config.h"
#include "cell/runtime/cell_io.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_runtime {

class GuardWatch {
 public:
  using Clock = std::chrono::steady_clock;

  // References must outlive it.
  GuardWatch(const config::CellConfig& config, const CellIo& io, log::Logger& log);

  // Returns once a guard watches, if one is wanted. Fails with R0046.
  [[nodiscard]] result::Result<void> start();
  void turn(Clock::time_point now = Clock::now());

  // For the status; empty if nothing is to be said.
  const std::string& note() const { return note_; }

 private:
  void replace(Clock::time_point now);
  void end_silent(const io_memory::GuardFigures& guard, Clock::time_point now);
  void reap();

  const config::CellConfig& config_;
  const CellIo& io_;
  log::Logger& log_;
  std::string note_;
  pid_t child_ = -1;  // the one that was started last, until its end was taken note of
  bool missing_ = false;
  Clock::time_point missing_since_{};
  Clock::time_point tried_{};
  std::uint64_t lost_ = 0;
};

}  // namespace stepwright::cell_runtime
