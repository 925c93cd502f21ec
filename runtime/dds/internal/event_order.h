#pragma once

// Puts the events of a runtime into their order: holds what came too early, drops what came twice, and says
// what is missing so that it can be asked for again.
//
// Threads: none of its own; the owner locks.
// Invariants: events leave with consecutive sequence numbers, except where the runtime has forgotten some
// (skip_to) or a new incarnation begins.

#include <cstdint>
#include <map>
#include <optional>

#include "runtime/dds/types.h"

namespace stepwright::dds::internal {

class EventOrder {
 public:
  // Held events beyond this are dropped; they are asked for again later.
  static constexpr std::size_t kMaxHeld = 1'024;

  // Takes the newest status. The first one decides where this client starts: after the newest event, or with
  // it while the runtime waits for its acknowledgement. Another incarnation starts anew at its first event.
  void observe(const RuntimeStatus& status);
  // An event that arrived; one of another incarnation than the status named is dropped.
  void add(StepEvent event);
  // The next event in order.
  std::optional<StepEvent> take();
  // The first sequence that is known to exist and has not arrived.
  std::optional<std::uint64_t> missing() const;
  // The runtime holds nothing before `sequence` any more.
  void skip_to(std::uint64_t sequence);

  bool started() const { return started_; }

 private:
  bool started_ = false;
  std::uint64_t incarnation_ = 0;
  std::uint64_t next_ = 1;
  std::uint64_t newest_ = 0;  // the highest sequence that is known to exist
  std::map<std::uint64_t, StepEvent> held_;
};

}  // namespace stepwright::dds::internal
