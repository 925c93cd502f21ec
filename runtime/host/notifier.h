#pragma once

// Wakes one thread from another: a descriptor (eventfd) that is readable after `ring` until `clear`.
//
// Threads: ring and clear from any thread. No heap or lock.

#include <cstdint>

namespace stepwright::host {

class Doorbell {
 public:
  Doorbell();
  ~Doorbell();
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  bool ok() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  void ring();
  void clear();
  // Waits until it rings or `timeout_ns` has passed (negative: without end), then clears it.
  void wait(std::int64_t timeout_ns);

 private:
  int descriptor_;
};

}  // namespace stepwright::host
