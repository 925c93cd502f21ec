#pragma once

// An allocation problem with its loads divided into trips, in whole milliseconds: what both searches work on.
//
// A stop is a number: 2 * trip for its pick-up, 2 * trip + 1 for its set-down. Its timepoint in the network
// is the beginning of the service there. Immutable once made; any thread may read.
//
//   const TripModel model = make_model(problem, Selection(problem), division, Ways::AsGiven);
//   if (!model.contradiction()) ...

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/allocation/internal/divisions.h"
#include "supervisor/fleet/network/network.h"

namespace stepwright::fleet::internal {

// Longer than any way; two of them can be added.
inline constexpr std::int32_t kNoWay = 1'000'000'000;
inline constexpr std::uint32_t kNone = 0xffffffff;

using StopIndex = std::uint32_t;
constexpr StopIndex pick_up_of(std::uint32_t trip) {
  return 2 * trip;
}
constexpr StopIndex set_down_of(std::uint32_t trip) {
  return 2 * trip + 1;
}
constexpr std::uint32_t trip_of(StopIndex stop) {
  return stop / 2;
}
constexpr bool is_pick_up(StopIndex stop) {
  return stop % 2 == 0;
}

using Route = std::vector<StopIndex>;
using Routes = std::vector<Route>;  // by vehicle

struct Trip {
  std::uint32_t transport = 0;
  std::uint32_t amount = 0;
  std::vector<char> vehicles;               // by vehicle, 1: may take it
  std::uint32_t alike = kNone;              // the trip before, if the two can be exchanged
  std::vector<std::uint32_t> predecessors;  // by the same vehicle, and set down before this one is picked up
  std::vector<std::uint32_t> successors;
  bool coupled = false;  // a constraint ties its times to others than time zero
};

struct Driver {
  std::uint32_t vehicle_class = 0;
  std::uint32_t start = 0;  // place
  std::uint32_t finish = kNone;
  std::uint32_t capacity = 0;
  std::int32_t available_ms = 0;
  Route fixed;               // it begins with these stops
  bool whole = false;        // and makes no others
  bool like_before = false;  // it can be exchanged with the vehicle before it
};

// Nothing else counts than the way from place to place: AsGiven. Closed: by way of others, if that is less.
enum class Ways : std::uint8_t { AsGiven, Closed };

class TripModel {
 public:
  std::uint32_t trips() const { return static_cast<std::uint32_t>(trips_.size()); }
  std::uint32_t vehicles() const { return static_cast<std::uint32_t>(drivers_.size()); }
  std::uint32_t stops() const { return 2 * trips(); }
  const Trip& trip(std::uint32_t t) const { return trips_[t]; }
  const Driver& driver(std::uint32_t v) const { return drivers_[v]; }
  const AllocationProblem& problem() const { return *problem_; }
  const Transport& transport_of(std::uint32_t t) const { return problem_->transports[trips_[t].transport]; }

  // No choice of routes can help: fixed parts contradict each other, or the constraints do.
  bool contradiction() const { return contradiction_; }
  // Some trip is coupled: times need the network.
  bool coupled() const { return coupled_; }

  std::uint32_t place(StopIndex stop) const { return place_[stop]; }
  std::int32_t service_ms(StopIndex stop) const { return service_[stop]; }
  // kNoWay if there is none.
  std::int32_t way_ms(std::uint32_t vehicle, std::uint32_t from, std::uint32_t to) const {
    return ways_[drivers_[vehicle].vehicle_class][from * places_ + to];
  }
  // By way of other places, if that is less: no route is shorter, whatever else it serves.
  std::int32_t least_way_ms(std::uint32_t vehicle, std::uint32_t from, std::uint32_t to) const {
    return least_ways_[drivers_[vehicle].vehicle_class][from * places_ + to];
  }

  // When a service can begin at all, whoever does it.
  std::int32_t earliest_ms(StopIndex stop) const { return earliest_[stop]; }
  std::int32_t latest_ms(StopIndex stop) const { return latest_[stop]; }

  std::size_t timepoints() const { return 1 + stops() + 2 * static_cast<std::size_t>(vehicles()); }
  static Timepoint at(StopIndex stop) { return Timepoint(1 + stop); }
  Timepoint start_of(std::uint32_t vehicle) const { return Timepoint(1 + stops() + vehicle); }
  Timepoint finish_of(std::uint32_t vehicle) const { return Timepoint(1 + stops() + vehicles() + vehicle); }
  // Constraints that hold for any routes; consistent unless contradiction().
  std::span<const Constraint> constraints() const { return constraints_; }
  // When a vehicle leaves at the earliest.
  std::int32_t start_ms(std::uint32_t vehicle) const { return starts_[vehicle]; }

 private:
  friend class TripModelMaker;

  const AllocationProblem* problem_ = nullptr;
  std::vector<Trip> trips_;
  std::vector<Driver> drivers_;
  std::size_t places_ = 0;
  std::vector<std::vector<std::int32_t>> ways_;  // by class; row: from
  std::vector<std::vector<std::int32_t>> least_ways_;
  std::vector<std::uint32_t> place_;
  std::vector<std::int32_t> service_;
  std::vector<std::int32_t> earliest_;
  std::vector<std::int32_t> latest_;
  std::vector<std::int32_t> starts_;
  std::vector<Constraint> constraints_;
  bool contradiction_ = false;
  bool coupled_ = false;
};

// The problem outlives the model.
TripModel make_model(const AllocationProblem& problem, const Selection& selection, const Division& division,
                     Ways ways);

}  // namespace stepwright::fleet::internal
