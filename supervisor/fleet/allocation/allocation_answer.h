#pragma once

// Answer to an allocation problem: which vehicle takes which load in which order, or why no vehicles can.
//
// Values; any thread may read.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/allocation/allocation_problem.h"

namespace stepwright::fleet {

enum class AllocationVerdict : std::uint8_t {
  Optimal,     // proved, among the divisions of loads into full loads and a rest
  Feasible,    // the best found; `lower_bound` says how far from the best at most
  Infeasible,  // proved
  Exhausted,   // the budget ended before anything was found or refuted
  Cancelled,   // likewise; an allocation that was found before is Feasible
};

struct RouteStop {
  LoadAction action = LoadAction::PickUp;
  TransportId transport;
  LocationId location;
  std::uint32_t amount = 0;            // taken or left
  std::uint32_t aboard = 0;            // when it drives on
  std::chrono::milliseconds begin{0};  // of the service; the earliest time that all constraints allow
  std::chrono::milliseconds end{0};    // of the service
};

// By vehicle, in the order of the problem. A vehicle without anything to do has no stops.
struct VehicleRoute {
  std::vector<RouteStop> stops;
  std::chrono::milliseconds start{0};  // when it may leave
  std::chrono::milliseconds finish{
      0};  // end of the last stop, or arrival at the finish; its start if neither
  std::chrono::milliseconds travel{0};
};

// Why there is no allocation. These transports cannot be carried together under these constraints and fixed
// parts. If minimal, they could without any one of what is named here.
struct AllocationConflict {
  std::vector<TransportId> transports;
  std::vector<std::uint32_t> constraints;  // indices into the problem
  std::vector<TransportId> vehicles;       // transports whose vehicle is fixed
  std::vector<std::uint32_t> orders;
  std::vector<std::uint32_t> routes;
  bool minimal = false;  // false: the budget ended while it was made smaller
};

struct AllocationFigures {
  std::size_t trips = 0;
  std::uint64_t nodes = 0;       // of branch and bound
  std::uint64_t iterations = 0;  // of large neighbourhood search
  double first_ms = 0.0;         // to the first allocation
  double exact_ms = 0.0;
  double improve_ms = 0.0;
  double explain_ms = 0.0;
};

struct AllocationAnswer {
  AllocationVerdict verdict = AllocationVerdict::Exhausted;
  // Optimal and Feasible only:
  std::vector<VehicleRoute> routes;
  std::chrono::milliseconds makespan{0};
  std::chrono::milliseconds travel{0};
  std::chrono::milliseconds tardiness{0};  // weighted
  std::int64_t objective = 0;              // the weighted sum
  std::int64_t lower_bound = 0;            // no allocation is better
  // Infeasible only:
  AllocationConflict conflict;
  AllocationFigures figures;
};

// One sentence for each part of the reason.
std::string to_string(const AllocationConflict& conflict, const AllocationProblem& problem);

}  // namespace stepwright::fleet
