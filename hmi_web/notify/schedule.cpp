#include "hmi_web/notify/schedule.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace stepwright::notify {

namespace {

std::int64_t ms_of(Schedule::WallTime wall) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(wall.time_since_epoch()).count();
}

}  // namespace

Schedule::Schedule(const Channel& channel, Notifications told, WallTime wall)
    : at_least_(channel.at_least),
      delay_(channel.delay),
      repeat_(channel.repeat),
      told_before_(std::move(told)),
      begun_ms_(ms_of(wall)) {}

// A clock that was set back makes it no longer than a whole repetition.
std::chrono::milliseconds Schedule::rest_of(const Notification& before) const {
  const std::chrono::milliseconds whole = repeat_;
  return std::clamp(whole - std::chrono::milliseconds(begun_ms_ - before.told_ms),
                    std::chrono::milliseconds(0), whole);
}

std::vector<StandingAlarm> Schedule::due(const std::vector<StandingAlarm>& unacknowledged, Time now) {
  std::set<std::string_view> standing;
  std::vector<StandingAlarm> due;
  for (const StandingAlarm& alarm : unacknowledged) {
    if (alarm.priority > at_least_) continue;
    standing.insert(alarm.name);
    const auto [at, is_new] = watched_.try_emplace(alarm.name);
    Watched& watched = at->second;
    if (is_new || watched.raised_ns != alarm.raised_ns) watched = {alarm.raised_ns, now + delay_};
    const auto before = is_new ? told_before_.find(alarm.name) : told_before_.end();
    if (before != told_before_.end() && before->second.raised_ns == alarm.raised_ns) {
      watched.told_ms = std::max<std::int64_t>(before->second.told_ms, 1);
      watched.next = repeat_.count() == 0 ? Time::max() : now + rest_of(before->second);
    }
    if (now < watched.next || now < not_before_) continue;
    watched.sending = true;
    due.push_back(alarm);
  }
  std::erase_if(watched_, [&](const auto& each) { return !standing.contains(each.first); });
  return due;
}

void Schedule::sent(bool arrived, Time now, WallTime wall) {
  retry_ = arrived ? std::chrono::seconds(0) : std::clamp(2 * retry_, kFirstRetry, kLongestRetry);
  not_before_ = now + retry_;
  for (auto& [name, watched] : watched_) {
    if (!std::exchange(watched.sending, false) || !arrived) continue;
    watched.told_ms = ms_of(wall);
    watched.next = repeat_.count() > 0 ? now + repeat_ : Time::max();
  }
}

Notifications Schedule::told() const {
  Notifications told;
  for (const auto& [name, watched] : watched_)
    if (watched.told_ms != 0) told.emplace(name, Notification{watched.raised_ns, watched.told_ms});
  return told;
}

}  // namespace stepwright::notify
