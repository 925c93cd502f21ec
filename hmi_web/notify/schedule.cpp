#include "hmi_web/notify/schedule.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace stepwright::notify {

Schedule::Schedule(const Channel& channel, ToldAlarms told)
    : at_least_(channel.at_least),
      delay_(channel.delay),
      repeat_(channel.repeat),
      told_before_(std::move(told)) {}

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
    if (before != told_before_.end() && before->second == alarm.raised_ns) {
      watched.told = true;
      if (repeat_.count() == 0) watched.next = Time::max();
    }
    if (now < watched.next || now < not_before_) continue;
    watched.sending = true;
    due.push_back(alarm);
  }
  std::erase_if(watched_, [&](const auto& each) { return !standing.contains(each.first); });
  return due;
}

void Schedule::sent(bool arrived, Time now) {
  retry_ = arrived ? std::chrono::seconds(0) : std::clamp(2 * retry_, kFirstRetry, kLongestRetry);
  not_before_ = now + retry_;
  for (auto& [name, watched] : watched_) {
    if (!std::exchange(watched.sending, false) || !arrived) continue;
    watched.told = true;
    watched.next = repeat_.count() > 0 ? now + repeat_ : Time::max();
  }
}

ToldAlarms Schedule::told() const {
  ToldAlarms told;
  for (const auto& [name, watched] : watched_)
    if (watched.told) told.emplace(name, watched.raised_ns);
  return told;
}

}  // namespace stepwright::notify
