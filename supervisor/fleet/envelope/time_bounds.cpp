#include "supervisor/fleet/envelope/time_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stepwright::fleet {

namespace {

// Lengths are sums of many terms: a whole number of milliseconds may come out a little beside itself.
constexpr double kRounding_ms = 1e-6;
constexpr double kSlowest_mps = 1e-3;
constexpr double kFastest_mps = 100.0;

}  // namespace

result::Diagnostics check(const SpeedLimits& limits, const result::Location& where, std::string_view prefix) {
  result::Diagnostics found;
  const auto add = [&](std::string message) {
    found.push_back({"F0502", result::Severity::Error, where, std::move(message), {}});
  };
  if (!(limits.max_mps >= kSlowest_mps && limits.max_mps <= kFastest_mps)) {
    add(fmt::format("{}max_mps is {} m/s, outside {} to {}", prefix, limits.max_mps, kSlowest_mps,
                    kFastest_mps));
  } else if (!(limits.min_mps >= 0.0 && limits.min_mps <= limits.max_mps)) {
    add(fmt::format("{0}min_mps is {1} m/s, outside 0 to {0}max_mps {2} m/s", prefix, limits.min_mps,
                    limits.max_mps));
  }
  return found;
}

Bounds time_bounds(double length_m, const SpeedLimits& limits) {
  const auto horizon_ms = static_cast<double>(limits.horizon.count());
  const double least_ms = std::min(std::ceil(1000.0 * length_m / limits.max_mps - kRounding_ms), horizon_ms);
  double most_ms = horizon_ms;
  if (limits.min_mps > 0.0) {
    most_ms = std::min(std::floor(1000.0 * length_m / limits.min_mps + kRounding_ms), horizon_ms);
  }
  const auto whole = [](double ms) { return std::chrono::milliseconds(static_cast<std::int64_t>(ms)); };
  return {whole(least_ms), whole(std::max(least_ms, most_ms))};
}

}  // namespace stepwright::fleet
