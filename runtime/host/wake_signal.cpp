#include "runtime/host/wake_signal.h"

#include <time.h>

#include <cerrno>

namespace stepwright::host {

void WakeSignal::clear() {
  while (sem_trywait(&semaphore_) == 0) {
  }
}

void WakeSignal::wait() {
  while (sem_wait(&semaphore_) != 0 && errno == EINTR) {
  }
  clear();
}

bool WakeSignal::wait_until(std::int64_t instant_ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const timespec until{instant_ns / kSecond, instant_ns % kSecond};
  int outcome = 0;
  while ((outcome = sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until)) != 0 && errno == EINTR) {
  }
  if (outcome != 0) return true;
  clear();
  return false;
}

}  // namespace stepwright::host
