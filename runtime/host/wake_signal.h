#pragma once

// Wakes the scan thread from its wait for an instant, so that a command need not wait for the next scan. A
// wait is one system call, to an absolute instant; a notification is one only if somebody waits.
//
// Threads: notify from any thread, the waits from one. No heap or lock.
//
//   while (!wake.wait_until(due_ns)) take_commands();

#include <semaphore.h>

#include <cstdint>

namespace stepwright::host {

class WakeSignal {
 public:
  WakeSignal() { sem_init(&semaphore_, 0, 0); }
  ~WakeSignal() { sem_destroy(&semaphore_); }
  WakeSignal(const WakeSignal&) = delete;
  WakeSignal& operator=(const WakeSignal&) = delete;

  void notify() { sem_post(&semaphore_); }
  // Until a notification, one that came before included.
  void wait();
  // Until a notification (false) or the monotonic clock shows `instant_ns` (true), whatever comes first.
  bool wait_until(std::int64_t instant_ns);

 private:
  // All notifications so far are answered by one wake-up.
  void clear();

  sem_t semaphore_;
};

}  // namespace stepwright::host
