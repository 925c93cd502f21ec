#pragma once

// The clock that measures how long a scan takes. It is passed in: the host gives its monotonic clock, a board
// its timer, a test a counter.

#include <cstdint>

namespace stepwright::scan {

class Clock {
 public:
  virtual ~Clock() = default;

  // Nanoseconds since any fixed instant; never goes back. Called on the scan thread: no heap, lock or log.
  virtual std::int64_t now_ns() = 0;
};

}  // namespace stepwright::scan
