#include "hmi_web/alarms/condition.h"

#include <algorithm>
#include <cmath>

namespace stepwright::alarms {

bool Condition::holds(double value, bool usable) const {
  if (settings_.kind == ConditionKind::Bad) return !usable;
  if (!usable || std::isnan(value)) return seen_;
  switch (settings_.kind) {
    case ConditionKind::High:
      return value > (seen_ ? settings_.limit - settings_.deadband : settings_.limit);
    case ConditionKind::Low:
      return value < (seen_ ? settings_.limit + settings_.deadband : settings_.limit);
    case ConditionKind::On:
      return value != 0.0;
    case ConditionKind::Off:
      return value == 0.0;
    case ConditionKind::Bad:
      break;
  }
  return false;
}

std::int64_t Condition::delay_ns() const {
  return seen_ ? settings_.on_delay.count() : settings_.off_delay.count();
}

std::optional<ConditionChange> Condition::offer(std::int64_t time_ns, double value, bool usable) {
  newest_ns_ = std::max(newest_ns_, time_ns);
  const bool now = holds(value, usable);
  if (now != seen_) {
    seen_ = now;
    since_ns_ = newest_ns_;
    value_ = value;
  }
  return expire(newest_ns_);
}

std::optional<ConditionChange> Condition::expire(std::int64_t time_ns) {
  const auto due = deadline();
  if (!due || *due > time_ns) return std::nullopt;
  active_ = seen_;
  return ConditionChange{*due, active_, value_};
}

std::optional<std::int64_t> Condition::deadline() const {
  if (seen_ == active_) return std::nullopt;
  return since_ns_ + delay_ns();
}

}  // namespace stepwright::alarms
