#pragma once

// The condition of an alarm over time: limit, deadband, delays. Changes have the time at which they became
// true, not the one at which somebody looked: a delay ends at its own instant.
//
//   Condition condition({ConditionKind::High, 9.5, 0.2, seconds(1)});
//   condition.offer(t, 9.6, true);        // no change yet; deadline() is t + 1 s
//   condition.expire(t + 3 s);            // raised, at t + 1 s
//
// Not thread-safe. Times of one condition do not run backwards: what is older than the newest counts as that.

#include <cstdint>
#include <optional>

#include "hmi_web/alarms/definition.h"

namespace stepwright::alarms {

struct ConditionChange {
  std::int64_t time_ns = 0;
  bool active = false;
  double value = 0.0;  // that made it so
  // The change was not observed: it was between this time, when the condition was seen last, and `time_ns`.
  // 0: it was observed.
  std::int64_t unseen_since_ns = 0;
};

class Condition {
 public:
  explicit Condition(const ConditionSettings& settings) : settings_(settings) {}

  // A value of a scan. A value that is not usable (bad, missing, NaN) says nothing about limits. Call
  // expire(time_ns) first. `time_known`: it is the time at which the value became so, whoever saw it when.
  std::optional<ConditionChange> offer(std::int64_t time_ns, double value, bool usable,
                                       bool time_known = false);
  // A delay that is over at `time_ns`.
  std::optional<ConditionChange> expire(std::int64_t time_ns);
  // When the delay that runs is over.
  std::optional<std::int64_t> deadline() const;

  bool active() const { return active_; }
  // The state at the end of the process before this one.
  void restore(bool active) { active_ = seen_ = active; }
  // Nothing has been seen since then, until the next value that is usable.
  void blind_since(std::int64_t time_ns) { blind_since_ns_ = time_ns; }

 private:
  bool holds(double value, bool usable) const;
  std::int64_t delay_ns() const;

  ConditionSettings settings_;
  bool active_ = false;  // after the delays
  bool seen_ = false;    // before them
  std::int64_t since_ns_ = 0;
  double value_ = 0.0;  // that changed `seen_`
  std::int64_t newest_ns_ = INT64_MIN;
  std::int64_t blind_since_ns_ = 0;   // 0: the newest value was usable, or none has ever come
  std::int64_t unseen_since_ns_ = 0;  // of what changed `seen_`
};

}  // namespace stepwright::alarms
