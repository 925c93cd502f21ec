#pragma once

// When a channel tells of which alarms: each that is unacknowledged for the channel's delay, again after
// every repetition, all that are due together in one message. An alarm that was acknowledged, or went for
// good, and comes again begins anew. What could not be sent is tried again: after a minute, then twice as
// long each time, up to a quarter of an hour.
//
//   Schedule schedule(channel);
//   const auto due = schedule.due(standing, now);     // now and then
//   if (!due.empty()) schedule.sent(send(message(due)), now);
//
// Pure; one thread at a time. Times are of a steady clock.

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "hmi_web/notify/channel.h"
#include "hmi_web/notify/told_store.h"

namespace stepwright::notify {

class Schedule {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kFirstRetry{60};
  static constexpr std::chrono::seconds kLongestRetry{900};

  // `told` is what an earlier one has told of: who is told once is not told of that again.
  explicit Schedule(const Channel& channel, ToldAlarms told = {});

  // Of all that are unacknowledged, those to tell of now.
  std::vector<StandingAlarm> due(const std::vector<StandingAlarm>& unacknowledged, Time now);
  // What became of those that were due last.
  void sent(bool arrived, Time now);
  // Of all that are unacknowledged, those that were told of, and when they were raised.
  ToldAlarms told() const;

 private:
  struct Watched {
    std::int64_t raised_ns = 0;  // another one: it has come again
    Time next{};
    bool sending = false;  // in the message that is under way
    bool told = false;
  };

  const alarms::Priority at_least_;
  const std::chrono::seconds delay_, repeat_;
  const ToldAlarms told_before_;
  std::map<std::string, Watched, std::less<>> watched_;
  std::chrono::seconds retry_{0};  // 0: the last message has arrived
  Time not_before_{};
};

}  // namespace stepwright::notify
