#include "supervisor/fleet/allocation/travel_times.h"

#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet {

TravelTimes::TravelTimes(std::size_t locations)
    : locations_(locations), times_ms_(locations * locations, -1) {
  for (std::size_t i = 0; i < locations; ++i) times_ms_[i * locations + i] = 0;
}

void TravelTimes::set(LocationId from, LocationId to, std::chrono::milliseconds time) {
  assert(from.value < locations_ && to.value < locations_);
  assert(time.count() >= 0 && time.count() <= kHorizon_ms);
  times_ms_[from.value * locations_ + to.value] = static_cast<std::int32_t>(time.count());
}

std::optional<std::chrono::milliseconds> TravelTimes::operator()(LocationId from, LocationId to) const {
  assert(from.value < locations_ && to.value < locations_);
  const std::int32_t time_ms = times_ms_[from.value * locations_ + to.value];
  if (time_ms < 0) return std::nullopt;
  return std::chrono::milliseconds(time_ms);
}

}  // namespace stepwright::fleet
