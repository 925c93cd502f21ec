#pragma once

// The newest events of a runtime, for clients that missed some.
//
// Threads: one. Invariant: sequence numbers grow; bounded in number and bytes.

#include <cstddef>
#include <cstdint>
#include <deque>

#include "runtime/host/messages.h"

namespace stepwright::service::internal {

class EventHistory {
 public:
  static constexpr std::size_t kMaxEvents = 4'096;
  static constexpr std::size_t kMaxBytes = 64u << 20;

  void append(host::StepEvent event);
  // The oldest event that is held with at least this sequence; null if there is none.
  const host::StepEvent* at_or_after(std::uint64_t sequence) const;
  // Sequence of the newest event ever appended; 0 before the first.
  std::uint64_t last() const { return last_; }

 private:
  static std::size_t bytes_of(const host::StepEvent& event);

  std::deque<host::StepEvent> events_;
  std::size_t bytes_ = 0;
  std::uint64_t last_ = 0;
};

}  // namespace stepwright::service::internal
