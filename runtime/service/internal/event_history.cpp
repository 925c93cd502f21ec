#include "runtime/service/internal/event_history.h"

#include <algorithm>
#include <utility>

namespace stepwright::service::internal {

std::size_t EventHistory::bytes_of(const host::StepEvent& event) {
  return sizeof event + event.image.size() + event.detail.size() +
         event.plant.size() * sizeof(host::NamedValue);
}

void EventHistory::append(host::StepEvent event) {
  bytes_ += bytes_of(event);
  last_ = event.sequence;
  events_.push_back(std::move(event));
  while (events_.size() > kMaxEvents || (bytes_ > kMaxBytes && events_.size() > 1)) {
    bytes_ -= bytes_of(events_.front());
    events_.pop_front();
  }
}

const host::StepEvent* EventHistory::at_or_after(std::uint64_t sequence) const {
  const auto found = std::lower_bound(events_.begin(), events_.end(), sequence,
                                      [](const auto& event, std::uint64_t s) { return event.sequence < s; });
  return found == events_.end() ? nullptr : &*found;
}

}  // namespace stepwright::service::internal
