#include "hmi_web/recorder/calendar.h"

#include <algorithm>

namespace stepwright::recorder {

std::int64_t Calendar::at(std::int64_t wall_ns, std::int64_t steady_ns) {
  const std::int64_t passed_ns = steady_ns_ == 0 ? 0 : std::max<std::int64_t>(0, steady_ns - steady_ns_);
  steady_ns_ = steady_ns;
  const bool known = newest_ns_ > 0;
  const std::int64_t expected_ns = newest_ns_ + passed_ns;
  const bool accepted = accepted_.exchange(false);
  const bool doubted = known && !accepted && wall_ns - expected_ns > kLargestStepNs;
  ahead_ns_ = doubted ? wall_ns - expected_ns : 0;
  const std::int64_t time_ns = doubted ? expected_ns : wall_ns;
  newest_ns_ = std::max(newest_ns_, time_ns);
  return time_ns;
}

bool Calendar::accept() {
  if (ahead_ns_ == 0) return false;
  accepted_ = true;
  return true;
}

}  // namespace stepwright::recorder
