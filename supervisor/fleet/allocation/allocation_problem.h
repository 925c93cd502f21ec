#pragma once

// Allocation problem (Pecora and Cirillo 2012, definition 2): vehicles with capacities, goals <k, s, g> as
// transports, temporal constraints between them, and what operators have fixed by hand.
//
// Values; any thread may read. Ids are indices into the vectors of the problem.
//
//   AllocationProblem problem;
//   problem.locations = {"dock", "rack"};
//   problem.classes = {times};
//   problem.vehicles = {{.name = "v1", .start = dock, .capacity = 2}};
//   problem.transports = {{.name = "pallets", .amount = 3, .from = dock, .to = rack, .due = 5min}};
//   problem.constraints = {{.name = "pallets within ten minutes",
//                           .to = end_of(pallets), .distance = {0ms, 10min}}};

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/allocation/travel_times.h"

namespace stepwright::fleet {

struct VehicleTag;
using VehicleId = base::StrongId<VehicleTag>;
struct TransportTag;
using TransportId = base::StrongId<TransportTag>;

struct TransportVehicle {
  std::string name;
  std::uint32_t vehicle_class = 0;  // index into AllocationProblem::classes
  LocationId start;
  std::uint32_t capacity = 1;              // units of load that it carries at once
  std::chrono::milliseconds available{0};  // it does not leave its start before
  std::optional<LocationId> finish = {};   // where it drives in the end, with or without anything to do
};

// A goal: `amount` units from `from` to `to`. If it is divisible, several trips may share it: full loads of
// vehicles and one rest. A trip is one pick-up and one set-down by the same vehicle.
struct Transport {
  std::string name;
  std::uint32_t amount = 1;
  LocationId from;
  LocationId to;
  std::chrono::milliseconds pick_up_service{0};   // how long the vehicle stands there, for each trip
  std::chrono::milliseconds set_down_service{0};  // likewise
  bool divisible = true;
  std::optional<VehicleId> vehicle = {};  // fixed by an operator: no other vehicle takes any of it
  std::optional<std::chrono::milliseconds> due = {};  // later costs tardiness; it is no constraint
  std::uint32_t weight = 1;                           // of its tardiness
};

enum class TransportMoment : std::uint8_t {
  TimeZero,
  VehicleStart,    // a vehicle leaves its start, or begins to stand there for good
  TransportStart,  // a vehicle begins to pick up
  TransportEnd,    // it has set down
};

// A timepoint of the paper's T. Of a transport that is divided, it is that of each trip: constraints hold for
// all of them, within one transport for each trip by itself.
struct TransportTimepoint {
  TransportMoment moment = TransportMoment::TimeZero;
  std::uint32_t index = 0;  // of the vehicle or the transport

  friend auto operator<=>(const TransportTimepoint&, const TransportTimepoint&) = default;
};
constexpr TransportTimepoint start_of(VehicleId vehicle) {
  return {TransportMoment::VehicleStart, vehicle.value};
}
constexpr TransportTimepoint start_of(TransportId transport) {
  return {TransportMoment::TransportStart, transport.value};
}
constexpr TransportTimepoint end_of(TransportId transport) {
  return {TransportMoment::TransportEnd, transport.value};
}

// least <= t(to) - t(from) <= most. Distances of the horizon (100,000 s) and above, either way, bind nothing;
// `least` may be negative.
struct TransportConstraint {
  std::string name;  // what explanations call it
  TransportTimepoint from = {};
  TransportTimepoint to = {};
  struct Distance {
    std::chrono::milliseconds least{0};
    std::chrono::milliseconds most{0};
  } distance;
};

// Fixed by an operator: one vehicle takes both, and has set down all of `before` when it picks `after` up.
struct FixedOrder {
  TransportId before;
  TransportId after;
};

enum class LoadAction : std::uint8_t { PickUp, SetDown };

struct FixedStop {
  LoadAction action = LoadAction::PickUp;
  TransportId transport;
  std::uint32_t amount = 0;  // of this trip; not 0
};

// Fixed by an operator, or by what a vehicle has already begun: it makes these stops in this order. Each
// set-down belongs to the first pick-up of the same transport and amount that is still aboard.
struct FixedRoute {
  VehicleId vehicle;
  std::vector<FixedStop> stops;
  bool whole =
      true;  // nothing else comes after them; otherwise they are the beginning. At most one a vehicle
};

// The weighted sum of three parts, each in milliseconds, that is to be small. For one before the other give
// them weights far apart.
struct AllocationObjective {
  std::uint32_t makespan = 1000;  // when the last vehicle has made its last stop, or is at its finish
  std::uint32_t travel = 1;       // what all vehicles drive together
  std::uint32_t tardiness = 0;    // the sum over transports of weight times how much later than due they end
};

struct AllocationProblem {
  std::vector<std::string> locations;  // their names
  std::vector<TravelTimes> classes;    // of vehicles
  std::vector<TransportVehicle> vehicles;
  std::vector<Transport> transports;
  std::vector<TransportConstraint> constraints;
  std::vector<FixedOrder> orders;
  std::vector<FixedRoute> routes;
  AllocationObjective objective;
};

}  // namespace stepwright::fleet
