#include "runtime/host/real_time.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
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

std::string place_thread(const ThreadPlacement& placement) {
  std::string refused;
  const auto note = [&refused](const std::string& text) {
    if (!refused.empty()) refused += "; ";
    refused += text;
  };
  cpu_set_t set;
  CPU_ZERO(&set);
  if (placement.cpu >= 0) {
    CPU_SET(static_cast<unsigned>(placement.cpu), &set);
    if (const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set); error != 0) {
      note("not on processor " + std::to_string(placement.cpu) + " (" + std::strerror(error) + ")");
    }
  } else if (sched_getaffinity(getpid(), sizeof set, &set) == 0) {
    // Those of the process' first thread, which nobody binds.
    static_cast<void>(pthread_setaffinity_np(pthread_self(), sizeof set, &set));
  }
  sched_param parameters{};
  parameters.sched_priority = placement.background ? 0 : std::max(kPriority - placement.rank, 1);
  const int policy = placement.background ? SCHED_OTHER : SCHED_FIFO;
  if (const int error = pthread_setschedparam(pthread_self(), policy, &parameters); error != 0) {
    note(std::string("no real-time priority (SCHED_FIFO: ") + std::strerror(error) + ")");
    // Without a priority the kernel at least must not round the sleep.
    prctl(PR_SET_TIMERSLACK, 1uL, 0uL, 0uL, 0uL);
  }
  return refused;
}

std::string lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return std::string("memory is not locked (mlockall: ") + std::strerror(errno) + ")";
}

void enter_monitor_priority() {
  sched_param parameters{};
  parameters.sched_priority = kPriority + 1;
  // Without it the monitor sees a late scan later, on a machine that has too much to do.
  static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters));
}

}  // namespace stepwright::host
