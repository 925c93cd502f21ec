#include "runtime/modbus/client/poll/unit.h"

#include <algorithm>

namespace stepwright::modbus::client {

std::uint64_t GroupPoll::advance(std::chrono::steady_clock::time_point now) {
  due += period;
  if (due > now) return 0;
  const auto missed = (now - due) / period + 1;
  due += missed * period;
  return static_cast<std::uint64_t>(missed);
}

Unit::Unit(const Device& device, Clock::time_point start, bool rests)
    : device_(&device), rests_(rests), writes_(device) {
  std::uint32_t first = 0;
  for (const Group& group : device.groups) {
    groups_.push_back({group.period, first, group.inputs, {}, start});
    first += static_cast<std::uint32_t>(group.inputs.size());
  }
  plan();
}

void Unit::plan() {
  const ReadLimits limits{device_->max_gap, device_->max_registers, device_->max_bits};
  for (GroupPoll& group : groups_) {
    group.requests = plan_reads(group.inputs, limits);
    if (group.next >= group.requests.size()) group.next = 0;
    for (ReadRequest& request : group.requests) {
      for (std::uint32_t& tag : request.tags) tag += group.first_input;
    }
  }
}

void Unit::begin_anew() {
  plan();
  writes_.forget();
}

void Unit::answered() {
  silences_ = 0;
  if (!asleep_) return;
  asleep_ = false;
  writes_.forget();  // it may have been switched off meanwhile
}

bool Unit::silent(Clock::time_point now, bool others_answer) {
  ++silences_;
  if (rests_) rests_until_ = now + device_->timeout;
  if (!asleep_ && silences_ <= device_->retries) return false;
  const auto longest = std::max(device_->retry_after, device_->retry_at_most);
  pause_ = asleep_ && others_answer ? std::min(2 * pause_, longest) : device_->retry_after;
  asleep_ = true;
  wakes_at_ = now + pause_;
  return true;
}

void Unit::hope(Clock::time_point at) {
  if (!asleep_) return;
  pause_ = device_->retry_after;
  wakes_at_ = std::min(wakes_at_, at);
}

GroupPoll* Unit::next_group() {
  const auto polled = [](const GroupPoll& group) { return !group.requests.empty(); };
  GroupPoll* next = nullptr;
  for (GroupPoll& group : groups_) {
    if (polled(group) && (next == nullptr || group.due < next->due)) next = &group;
  }
  return next;
}

}  // namespace stepwright::modbus::client
