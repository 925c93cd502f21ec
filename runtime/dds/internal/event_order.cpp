#include "runtime/dds/internal/event_order.h"

#include <algorithm>
#include <utility>

namespace stepwright::dds::internal {

void EventOrder::observe(const RuntimeStatus& status) {
  if (!started_ || status.incarnation != incarnation_) {
    const bool again = started_;
    started_ = true;
    incarnation_ = status.incarnation;
    next_ = again ? 1 : status.last_event + (status.waiting_for_supervisor ? 0 : 1);
    newest_ = 0;
    held_.clear();
  }
  newest_ = std::max(newest_, status.last_event);
}

void EventOrder::add(StepEvent event) {
  if (!started_ || event.incarnation != incarnation_ || event.sequence < next_) return;
  newest_ = std::max(newest_, event.sequence);
  if (held_.size() < kMaxHeld || event.sequence == next_) held_.emplace(event.sequence, std::move(event));
}

std::optional<StepEvent> EventOrder::take() {
  const auto first = held_.begin();
  if (first == held_.end() || first->first != next_) return std::nullopt;
  StepEvent event = std::move(first->second);
  held_.erase(first);
  ++next_;
  return event;
}

std::optional<std::uint64_t> EventOrder::missing() const {
  if (!started_ || next_ > newest_) return std::nullopt;
  if (!held_.empty() && held_.begin()->first == next_) return std::nullopt;
  return next_;
}

void EventOrder::skip_to(std::uint64_t sequence) {
  if (sequence <= next_) return;
  next_ = sequence;
  held_.erase(held_.begin(), held_.lower_bound(sequence));
}

}  // namespace stepwright::dds::internal
