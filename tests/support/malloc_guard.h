#pragma once

// Counts what the current thread must not do in a scan: heap allocations and mutex locks. The whole process
// links the counting functions in; the counters are per thread.
// Under a sanitizer, which replaces malloc itself, is_active() is false and nothing is counted.
//
//   const support::GuardCounts before = support::guard_counts();
//   cycle.run_scan();
//   EXPECT_EQ(support::guard_counts(), before);

#include <cstdint>

namespace stepwright::support {

struct GuardCounts {
  std::uint64_t allocations = 0;  // malloc, calloc, realloc, aligned_alloc, and operator new through them
  std::uint64_t frees = 0;
  std::uint64_t locks = 0;  // pthread_mutex_lock

  friend bool operator==(const GuardCounts&, const GuardCounts&) = default;
};

bool guard_is_active();
GuardCounts guard_counts();

}  // namespace stepwright::support
