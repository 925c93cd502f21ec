#pragma once

// Wakes the scan thread from its wait for an instant, so that what is asked of it does not have to wait for
// the next scan. A wait is one system call, to an absolute instant; a ring is one only if somebody waits.
//
// Threads: ring from any, the waits from one. No heap or lock.
//
//   while (!wake.wait_until(due_ns)) take_commands();

#include <semaphore.h>

#include <cstdint>

namespace stepwright::host {

class WakeSignal {
 public:
  WakeSignal() { sem_init(&rings_, 0, 0); }
  ~WakeSignal() { sem_destroy(&rings_); }
  WakeSignal(const WakeSignal&) = delete;
  WakeSignal& operator=(const WakeSignal&) = delete;

  void ring() { sem_post(&rings_); }
  // Until it rings. What rang before counts.
  void wait();
  // Until it rings (false) or the monotonic clock shows `instant_ns` (true), whatever comes first.
  bool wait_until(std::int64_t instant_ns);

 private:
  // However often it rang, it is answered once.
  void clear();

  sem_t rings_;
};

}  // namespace stepwright::host
