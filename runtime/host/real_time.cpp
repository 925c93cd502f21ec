#include "runtime/host/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <time.h>

#include <cerrno>
#include <cstring>

namespace stepwright::host {
namespace {

// Above ordinary real-time threads, below the kernel's own.
constexpr int kPriority = 80;
constexpr std::int64_t kSecond = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now_ns() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

void sleep_until(std::int64_t instant_ns) {
  const timespec until{instant_ns / kSecond, instant_ns % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

std::string enter_real_time() {
  std::string refused;
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters); error != 0) {
    refused += std::string("no real-time priority (SCHED_FIFO: ") + std::strerror(error) + ")";
    // Without a priority the kernel at least must not round the sleep.
    prctl(PR_SET_TIMERSLACK, 1uL, 0uL, 0uL, 0uL);
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    if (!refused.empty()) refused += "; ";
    refused += std::string("memory is not locked (mlockall: ") + std::strerror(errno) + ")";
  }
  return refused;
}

void enter_monitor_priority() {
  sched_param parameters{};
  parameters.sched_priority = kPriority + 1;
  // Without it the monitor sees a late scan later, on a machine that has too much to do.
  static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters));
}

}  // namespace stepwright::host
