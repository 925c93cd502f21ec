#include "hmi_web/alarms/statistics.h"

#include <algorithm>

namespace stepwright::alarms {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::size_t kMostFrequent = 10;

std::int64_t second_of(std::int64_t time_ns) {
  return time_ns >= 0 ? time_ns / kSecondNs : -((-time_ns + kSecondNs - 1) / kSecondNs);
}

std::size_t slot_of(std::int64_t second, std::int64_t window) {
  return static_cast<std::size_t>((second % window + window) % window);
}

bool is_active_and_shown(const AlarmStatus& status) {
  return status.active && !status.is_hidden();
}

}  // namespace

AlarmStatistics::AlarmStatistics(const std::vector<AlarmDefinition>& definitions)
    : alarms_(definitions.size()) {
  for (std::size_t i = 0; i < definitions.size(); ++i) alarms_[i].priority = definitions[i].priority;
}

// Seconds that end: what happened ten minutes before leaves the window.
void AlarmStatistics::pass(std::int64_t second) {
  if (!begun_) {
    begun_ = true;
    first_second_ = second_ = second;
    return;
  }
  // After a whole window without news there is nothing left to leave it.
  const std::int64_t steps = std::min(second - second_, kWindowSeconds);
  const std::int64_t skipped = std::max<std::int64_t>(0, second - second_ - steps);
  for (std::int64_t i = 0; i < steps; ++i) {
    ++second_;
    if (total_.flood) ++flood_seconds_;
    std::uint32_t& slot = seconds_[slot_of(second_, kWindowSeconds)];
    total_.in_ten_minutes -= slot;
    slot = 0;
    judge_flood();
  }
  if (skipped > 0) {
    second_ = second;
    seconds_.fill(0);
  }
}

void AlarmStatistics::judge_flood() {
  if (!total_.flood && total_.in_ten_minutes >= kFloodBegins) {
    total_.flood = true;
    ++total_.floods;
  } else if (total_.flood && total_.in_ten_minutes < kFloodEnds) {
    total_.flood = false;
  }
}

void AlarmStatistics::restore(AlarmId id, const AlarmView& view) {
  alarms_[id.value].status = view.status;
  alarms_[id.value].active_since_ns = view.raised_ns;
}

void AlarmStatistics::note(const Transition& transition) {
  pass(second_of(transition.time_ns));
  Alarm& alarm = alarms_[transition.alarm.value];
  const bool stood = is_active_and_shown(alarm.status);
  alarm.status = transition.status;
  if (!stood && is_active_and_shown(alarm.status)) alarm.active_since_ns = transition.time_ns;
  const bool told =
      transition.to == AlarmState::Unacknowledged && transition.from != AlarmState::Unacknowledged;
  if (!told) return;
  alarm.newest[alarm.annunciations++ % kChatterCount] = transition.time_ns;
  ++total_.annunciated;
  ++total_.in_ten_minutes;
  ++seconds_[slot_of(second_, kWindowSeconds)];
  total_.most_in_ten_minutes = std::max(total_.most_in_ten_minutes, total_.in_ten_minutes);
  judge_flood();
}

bool AlarmStatistics::chatters(const Alarm& alarm, std::int64_t now_ns) const {
  if (alarm.annunciations < kChatterCount) return false;
  const auto [oldest, newest] = std::ranges::minmax(alarm.newest);
  return newest - oldest <= kChatterNs && now_ns - newest <= kChatterNs;
}

AlarmFigures AlarmStatistics::figures(std::int64_t now_ns) {
  pass(second_of(now_ns));
  AlarmFigures made = total_;
  const std::int64_t passed = second_ - first_second_;
  if (passed > 0) made.flood_share = static_cast<double>(flood_seconds_) / static_cast<double>(passed);
  for (std::uint32_t i = 0; i < alarms_.size(); ++i) {
    const Alarm& alarm = alarms_[i];
    const AlarmId id(i);
    if (is_active_and_shown(alarm.status)) {
      ++made.standing[static_cast<std::size_t>(alarm.priority)];
      if (now_ns - alarm.active_since_ns > kStaleNs) made.stale.push_back(id);
    }
    const AlarmState state = alarm.status.state();
    made.unacknowledged += state == AlarmState::Unacknowledged ||
                                   state == AlarmState::ReturnedUnacknowledged ||
                                   state == AlarmState::LatchedUnacknowledged
                               ? 1
                               : 0;
    made.shelved += state == AlarmState::Shelved ? 1 : 0;
    made.suppressed += state == AlarmState::SuppressedByDesign ? 1 : 0;
    made.out_of_service += state == AlarmState::OutOfService ? 1 : 0;
    if (chatters(alarm, now_ns)) made.chattering.push_back(id);
    if (alarm.annunciations > 0) made.most_frequent.push_back({id, alarm.annunciations});
  }
  std::ranges::stable_sort(made.most_frequent, std::ranges::greater{}, &AlarmCount::count);
  if (made.most_frequent.size() > kMostFrequent) made.most_frequent.resize(kMostFrequent);
  return made;
}

}  // namespace stepwright::alarms
