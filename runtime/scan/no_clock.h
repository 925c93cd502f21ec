#pragma once

// A clock that stands still, where nobody asks how long a scan took.
//
// Threads: any.

#include "runtime/scan/clock.h"

namespace stepwright::scan {

class NoClock final : public Clock {
 public:
  std::int64_t now_ns() override { return 0; }
};

}  // namespace stepwright::scan
