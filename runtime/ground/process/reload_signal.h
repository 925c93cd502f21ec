#pragma once

// SIGHUP as a question to ask between two turns of a loop: whether the configuration is to be read again.
// Make it before any thread is started: threads inherit the blocked signal.

namespace stepwright::process {

class ReloadSignal {
 public:
  ReloadSignal();
  ~ReloadSignal();
  ReloadSignal(const ReloadSignal&) = delete;
  ReloadSignal& operator=(const ReloadSignal&) = delete;

  // Readable once a signal came, until it is taken.
  int descriptor() const { return descriptor_; }
  // True if a signal came since the last call.
  bool take();

 private:
  int descriptor_;
};

}  // namespace stepwright::process
