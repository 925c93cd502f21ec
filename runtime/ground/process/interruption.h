#pragma once

// SIGINT, SIGTERM and SIGHUP as a flag for long work that can be cancelled: the first one asks it to end with
// what it has, the next one ends the process at once.
//
// Thread rule: make it on the thread that starts the work, before any other: threads inherit the blocked
// signals. The flag may be read from any thread.
//
//   Interruption interruption;
//   options.cancel = interruption.flag();

#include <atomic>
#include <thread>

#include "runtime/ground/process/stop_signal.h"

namespace stepwright::process {

class Interruption {
 public:
  Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  // Joins the thread that waits. The signals stay blocked.
  ~Interruption();

  const std::atomic<bool>* flag() const { return &came_; }

 private:
  void watch();

  StopSignal signal_{OnHangup::End};
  int over_;  // an eventfd: the work is done
  std::atomic<bool> came_{false};
  std::thread watcher_;
};

}  // namespace stepwright::process
