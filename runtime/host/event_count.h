#pragma once

// Number of the events that a runtime has made, and how many of them were lost. No thread of its own: the
// one that makes the events owns it. No heap, no lock.

#include <cstdint>

namespace stepwright::host {

struct EventCount {
  std::uint64_t last = 0;  // sequence of the newest event, 0 = none yet
  std::uint64_t lost = 0;  // nobody took them in time

  std::uint64_t next() { return ++last; }
  void handed_over(bool taken) { lost += taken ? 0 : 1; }
};

}  // namespace stepwright::host
