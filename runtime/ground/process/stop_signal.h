#pragma once

// SIGTERM and SIGINT as a descriptor to poll, so that a process ends between two turns of its loop and never
// in the middle of one; SIGHUP, too, of a program that people start at a terminal and that has nothing to
// read again: a terminal that is closed ends it in order, unless it was started to stay (nohup). Make it
// before any thread is started: threads inherit the blocked signals.

#include <chrono>

namespace stepwright::process {

// Whether a terminal that is closed is to end this process.
bool ends_on_hangup();

enum class OnHangup { Leave, End };

class StopSignal {
 public:
  explicit StopSignal(OnHangup hangup = OnHangup::Leave);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  // Readable, for good, once one of the signals came.
  int descriptor() const { return descriptor_; }
  // True once one of the signals came.
  bool came() const;
  // Waits for one of the signals, at most this long; true if it came.
  bool wait_for(std::chrono::milliseconds time) const;
  // Returns once one of the signals came.
  void wait() const;

 private:
  int descriptor_;
};

}  // namespace stepwright::process
