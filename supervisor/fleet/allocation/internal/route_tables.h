#pragma once

// The least that any continuation of a route takes, by dynamic programming over sets of trips, without
// windows, couplings and orders: lower bounds for branch and bound, exact where there are none of those.
//
// Memory and time grow with 3^trips for each kind of vehicle: 9 MB with 10 trips. Immutable; any thread.
//
//   const RouteTables tables(model);
//   tables.rest(v, last_stop, aboard, to_do);  // what v still needs to make its last stop

#include <cstdint>
#include <vector>

#include "supervisor/fleet/allocation/internal/trip_model.h"

namespace stepwright::fleet::internal {

inline constexpr std::uint32_t kMostTableTrips = 11;

using TripMask = std::uint32_t;  // bit t: trip t

// Whether there are few enough trips and kinds of vehicles: tables take no more than 256 MB.
bool tables_fit(const TripModel& model);

struct Effort {
  std::int32_t time_ms = kNoWay;  // driving and services; not waiting
  std::int32_t travel_ms = kNoWay;
};

class RouteTables {
 public:
  // Requires tables_fit and no contradiction.
  explicit RouteTables(const TripModel& model);

  // From the end of the service at `last`: to set down what is aboard and to make all trips of `to_do`.
  Effort rest(std::uint32_t vehicle, StopIndex last, TripMask aboard, TripMask to_do) const {
    const std::size_t code = digits_[aboard] + 2 * static_cast<std::size_t>(digits_[to_do]);
    return kinds_[kind_of_[vehicle]].rest[code * model_.stops() + last];
  }
  // From its start; the time counts from time zero, and is 0 if it has nothing to do and no finish.
  Effort whole(std::uint32_t vehicle, TripMask to_do) const { return whole_[vehicle][to_do]; }
  // Of the vehicles from `vehicle` on, which share the trips: when the last one can be ready (time), and
  // what they drive together; each by itself.
  Effort shared(std::uint32_t vehicle, TripMask to_do) const { return shared_[vehicle][to_do]; }

 private:
  struct Kind {
    std::uint32_t vehicle = 0;  // the first of them
    std::vector<Effort> rest;   // by code, then by last stop
  };
  void fill(Kind& kind) const;
  Effort finish_from(std::uint32_t vehicle, std::uint32_t place) const;
  std::vector<Effort> from_start(std::uint32_t vehicle) const;
  void share();

  const TripModel& model_;
  std::vector<std::uint32_t> digits_;  // by mask: the sum of 3^t
  std::vector<Kind> kinds_;
  std::vector<std::size_t> kind_of_;
  std::vector<std::vector<Effort>> whole_;
  std::vector<std::vector<Effort>> shared_;
};

}  // namespace stepwright::fleet::internal
