#pragma once

// Composition of a status: what its detail says, a part after another, and its figures of the events. For the
// threads that compose a status; the scan thread does not.

#include <string>

#include "runtime/ground/result/counted.h"
#include "runtime/host/event_count.h"
#include "runtime/host/messages.h"

namespace stepwright::host {

inline void add_detail(RuntimeStatus& status, const std::string& text) {
  if (text.empty()) return;
  if (!status.detail.empty()) status.detail += "; ";
  status.detail += text;
}

inline void add_events(RuntimeStatus& status, const EventCount& events) {
  status.last_event = events.last;
  status.process.lost_events = events.lost;
  if (events.lost > 0) add_detail(status, result::counted(events.lost, "event was", "events were") + " lost");
}

}  // namespace stepwright::host
