#pragma once

// Wakes one thread from another: a descriptor (eventfd) that is readable after `notify` until `clear`.
//
// Threads: notify and clear from any thread. No heap or lock.

#include <cstdint>

namespace stepwright::host {

class Notifier {
 public:
  Notifier();
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  bool ok() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  void notify();
  void clear();
  // Waits for a notification or until `timeout_ns` has passed (negative: without end), then clears it.
  void wait(std::int64_t timeout_ns);

 private:
  int descriptor_;
};

}  // namespace stepwright::host
