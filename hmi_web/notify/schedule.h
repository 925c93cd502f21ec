#pragma once

// Schedule of a channel's messages: each that is unacknowledged for the channel's delay, again after every
// repetition, all that are due together in one message. An alarm that was acknowledged, or went for good, and
// comes again begins anew. What could not be sent is tried again: after a minute, then twice as long each
// time, up to a quarter of an hour.
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
#include "hmi_web/notify/notification_store.h"

namespace stepwright::notify {

class Schedule {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kFirstRetry{60};
  static constexpr std::chrono::seconds kLongestRetry{900};

  using WallTime = std::chrono::system_clock::time_point;

  // `told` is what an earlier one has told of, as seen at `wall`: its repetitions go on as if it were that
  // one.
  explicit Schedule(const Channel& channel, Notifications told = {},
                    WallTime wall = std::chrono::system_clock::now());

  // Of all that are unacknowledged, those to tell of now.
  std::vector<StandingAlarm> due(const std::vector<StandingAlarm>& unacknowledged, Time now);
  // What became of those that were due last.
  void sent(bool arrived, Time now, WallTime wall = std::chrono::system_clock::now());
  // Of all that are unacknowledged, those that were told of.
  Notifications told() const;

 private:
  struct Watched {
    std::int64_t raised_ns = 0;  // another one: it has come again
    Time next{};
    bool sending = false;      // in the message that is under way
    std::int64_t told_ms = 0;  // 0: it was not
  };
  // Until one that was told of before is told of again.
  std::chrono::milliseconds rest_of(const Notification& before) const;

  const alarms::Priority at_least_;
  const std::chrono::seconds delay_, repeat_;
  const Notifications told_before_;
  const std::int64_t begun_ms_;
  std::map<std::string, Watched, std::less<>> watched_;
  std::chrono::seconds retry_{0};  // 0: the last message has arrived
  Time not_before_{};
};

}  // namespace stepwright::notify
