#include "supervisor/translate/stn.h"

#include <algorithm>

namespace stepwright::translate {

namespace {

// Sums of durations in seconds differ by rounding only below this.
constexpr double kRounding_s = 1e-9;

}  // namespace

// Longest paths from event 0, by the rounds of Bellman and Ford: a round that still changes something after
// as many rounds as events has met a cycle of bounds that contradict each other.
std::optional<std::vector<double>> Stn::earliest() const {
  std::vector<double> times(events_, 0.0);
  for (std::size_t round = 0; round <= events_; ++round) {
    bool changed = false;
    for (const Bound& bound : bounds_) {
      const double time = times[bound.from] + bound.seconds;
      if (time <= times[bound.to] + kRounding_s) continue;
      times[bound.to] = time;
      changed = true;
    }
    if (times[0] > kRounding_s) return std::nullopt;
    if (!changed) return times;
  }
  return std::nullopt;
}

std::optional<std::vector<double>> Stn::latest(std::size_t last, double horizon_s) const {
  const auto first = earliest();
  if (!first || (*first)[last] > horizon_s + kRounding_s) return std::nullopt;
  std::vector<double> times(events_, horizon_s);
  times[0] = 0.0;
  for (std::size_t round = 0; round <= events_; ++round) {
    bool changed = false;
    for (const Bound& bound : bounds_) {
      const double time = times[bound.to] - bound.seconds;
      if (time >= times[bound.from] - kRounding_s) continue;
      times[bound.from] = time;
      changed = true;
    }
    for (std::size_t i = 0; i < events_; ++i) {
      if (times[i] < (*first)[i] - kRounding_s) return std::nullopt;
    }
    if (!changed) return times;
  }
  return std::nullopt;
}

}  // namespace stepwright::translate
