#pragma once

// A system that is short of threads or memory, at the moment that a test chooses. The whole process links the
// functions in that take the places of pthread_create and operator new.
// Under a sanitizer, which owns operator new, allocations do not fail (can_fail_allocations is false).
//
//   for (int nth = 1;; ++nth) {
//     support::FailingAllocation failing(nth, 64 << 10);
//     ... the command ...
//     if (!failing.happened()) break;                       // it needs fewer than that
//   }
//
// Threads: one at a time arms; the failures concern every thread but the one that arms.

#include <cstddef>
#include <functional>

namespace stepwright::support {

bool can_fail_allocations();

// While it lives, the `nth` allocation of at least `least_bytes` bytes fails, once.
class FailingAllocation {
 public:
  FailingAllocation(int nth, std::size_t least_bytes);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  bool happened() const;
};

// While it lives, the `nth` start of a thread fails with EAGAIN, once; of this thread, too.
class FailingThread {
 public:
  explicit FailingThread(int nth);
  ~FailingThread();
  FailingThread(const FailingThread&) = delete;
  FailingThread& operator=(const FailingThread&) = delete;
  bool happened() const;
};

// While it lives, `act` is called by whoever starts a thread, before that.
class BeforeThreads {
 public:
  explicit BeforeThreads(std::function<void()> act);
  ~BeforeThreads();
  BeforeThreads(const BeforeThreads&) = delete;
  BeforeThreads& operator=(const BeforeThreads&) = delete;
};

}  // namespace stepwright::support
