#pragma once

// Travel times of one class of vehicles from location to location.
//
// A value; any thread may read. Nothing: there is no way. Ways need not be equally long in both directions,
// nor be the shortest ones; from a location to itself it takes no time unless set otherwise.
//
//   TravelTimes times(locations);
//   times.set(dock, rack, 42s);
//   if (const auto way = times(dock, rack)) ...

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/base/strong_id.h"

namespace stepwright::fleet {

struct LocationTag;
using LocationId = base::StrongId<LocationTag>;

class TravelTimes {
 public:
  // No location is reached from another one yet.
  explicit TravelTimes(std::size_t locations = 0);

  std::size_t locations() const { return locations_; }

  // Not negative, at most kHorizon_ms.
  void set(LocationId from, LocationId to, std::chrono::milliseconds time);
  std::optional<std::chrono::milliseconds> operator()(LocationId from, LocationId to) const;

 private:
  std::size_t locations_;
  std::vector<std::int32_t> times_ms_;  // row: from; negative: no way
};

}  // namespace stepwright::fleet
