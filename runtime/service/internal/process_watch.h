#pragma once

// Figures of this process from the system, for the runtime's status. Threads: one. Reads /proc at most once a
// second.

#include <chrono>
#include <cstddef>
#include <string>

#include "runtime/host/messages.h"

namespace stepwright::service::internal {

class ProcessWatch {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ProcessWatch(std::string version);

  // Everything but traps and lost events, which the runtime knows.
  void fill(host::ProcessFigures& figures, std::size_t clients);

 private:
  std::string version_;
  Clock::time_point began_;
  Clock::time_point looked_{};
  std::uint64_t resident_bytes_ = 0;
};

}  // namespace stepwright::service::internal
