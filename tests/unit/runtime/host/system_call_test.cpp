// What a scan in real time asks of the kernel, seen from outside: a child process runs the runtime, and every
// system call of its scan thread is counted by tracing it.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <map>
#include <thread>

#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

struct Shared {
  std::atomic<pid_t> scan_thread{0};
  std::atomic<std::uint64_t> scans{0};
};

// Until it is killed.
[[noreturn]] void run_child(Shared& shared) {
  HostConfig config;
  config.clock = ClockMode::Real;
  Harness harness(config, false);
  harness.driver.on_read = [&shared](std::int64_t) {
    shared.scans.fetch_add(1);
    if (shared.scan_thread.load() == 0) shared.scan_thread.store(static_cast<pid_t>(syscall(SYS_gettid)));
  };
  // The last step stays: from then on nothing happens but scans.
  harness.load(support::step_program({.steps = 2, .scans_per_step = 1, .interval_us = 1'000}));
  harness.start();
  while (true) pause();
}

class Child {
 public:
  Child()
      : memory_(mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    new (memory_) Shared;
    pid_ = fork();
    if (pid_ == 0) {
      // It goes with the test, and others than its parent may trace it where the kernel asks for that.
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      run_child(shared());
    }
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, __WALL);
    munmap(memory_, sizeof(Shared));
  }
  Shared& shared() { return *static_cast<Shared*>(memory_); }

 private:
  void* memory_;
  pid_t pid_ = -1;
};

struct Calls {
  std::map<long, std::uint64_t> by_number;
  std::uint64_t total = 0;
};

// The number of the call that a stopped thread is about to make.
long call_number(pid_t thread) {
  __ptrace_syscall_info info{};
  ptrace(PTRACE_GET_SYSCALL_INFO, thread, sizeof info, &info);
  return info.op == PTRACE_SYSCALL_INFO_ENTRY ? static_cast<long>(info.entry.nr) : -1;
}

// Counts the calls of a thread until `until` holds.
Calls trace(pid_t thread, const std::function<bool()>& until) {
  Calls calls;
  EXPECT_EQ(ptrace(PTRACE_SEIZE, thread, nullptr, PTRACE_O_TRACESYSGOOD), 0) << strerror(errno);
  EXPECT_EQ(ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr), 0);
  while (true) {
    int status = 0;
    if (waitpid(thread, &status, __WALL) != thread || !WIFSTOPPED(status)) break;
    if (WSTOPSIG(status) == (SIGTRAP | 0x80)) {
      if (const long number = call_number(thread); number >= 0) {
        ++calls.by_number[number];
        ++calls.total;
      }
    }
    const bool ends = until();
    ptrace(ends ? PTRACE_DETACH : PTRACE_SYSCALL, thread, nullptr, nullptr);
    if (ends) break;
  }
  return calls;
}

TEST(SystemCalls, WhenAProgramRunsInRealTime_ThenAScanMakesAtMostTwo) {
  Child child;
  Shared& shared = child.shared();
  while (shared.scans.load() < 20) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::uint64_t before = shared.scans.load();
  const Calls calls = trace(shared.scan_thread.load(), [&] { return shared.scans.load() >= before + 300; });
  const std::uint64_t scans = shared.scans.load() - before;
  std::string seen;
  for (const auto& [number, count] : calls.by_number) {
    seen += std::to_string(number) + ": " + std::to_string(count) + "  ";
  }
  EXPECT_GE(calls.by_number.count(SYS_clock_nanosleep), 1u) << seen;
  EXPECT_LE(calls.total, 2 * scans + 2) << "in " << scans << " scans, by number: " << seen;
  EXPECT_EQ(calls.by_number.count(SYS_futex), 0u) << "a lock: " << seen;
  RecordProperty("calls_per_scan",
                 std::to_string(static_cast<double>(calls.total) / static_cast<double>(scans)));
}

}  // namespace
}  // namespace stepwright::host
