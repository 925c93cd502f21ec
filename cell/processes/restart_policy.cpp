#include "cell/processes/restart_policy.h"

#include <algorithm>

namespace stepwright::processes {

void RestartPolicy::ready(Time now) {
  if (!ready_since_) ready_since_ = now;
  failures_ = 0;
}

std::optional<std::chrono::milliseconds> RestartPolicy::ended(Time now) {
  if (ready_since_ && now - *ready_since_ >= settings_.steady) rest_ = settings_.first;
  if (!ready_since_ && ++failures_ >= settings_.most_failures) return std::nullopt;
  ready_since_.reset();
  const std::chrono::milliseconds rest = rest_;
  rest_ = std::min(rest_ * 2, settings_.longest);
  return rest;
}

}  // namespace stepwright::processes
