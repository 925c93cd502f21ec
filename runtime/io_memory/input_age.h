#pragma once

// Age of the inputs that a scan works on, where a read may fail: whether they may still be held, and how
// often they were. All instants of one clock, in ns.
//
// Thread rule: one thread; held_reads any.
//
//   if (read(inputs)) age.fresh(now_ns); else if (!age.held(now_ns, 100'000'000)) lost();

#include <atomic>
#include <cstdint>

namespace stepwright::io_memory {

class InputAge {
 public:
  void fresh(std::int64_t now_ns) {
    known_ = true;
    fresh_ns_ = now_ns;
  }

  // Counts. False if the newest fresh ones, or without any the first that were held, are older than the
  // limit.
  bool held(std::int64_t now_ns, std::int64_t limit_ns) {
    held_reads_.fetch_add(1, std::memory_order_relaxed);
    if (!known_) fresh(now_ns);
    return now_ns - fresh_ns_ <= limit_ns;
  }

  std::uint64_t held_reads() const { return held_reads_.load(std::memory_order_relaxed); }

 private:
  bool known_ = false;
  std::int64_t fresh_ns_ = 0;
  std::atomic<std::uint64_t> held_reads_{0};
};

}  // namespace stepwright::io_memory
