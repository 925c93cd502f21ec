#pragma once

// Task planning (module 1 of Pecora and Cirillo 2012, which leaves it out): which vehicle takes which load in
// which order. Branch and bound with proof of optimality where few trips are to be made, large neighbourhood
// search where many are (supervisor/doc/fleet_allocation.md).
//
// A pure function of its arguments but for the limits; any thread. With a limit on iterations and none on
// time the answer depends on problem and seed only.
//
//   const AllocationAnswer answer = allocate(problem, {.time = 500ms});
//   if (answer.verdict == AllocationVerdict::Infeasible) print(to_string(answer.conflict, problem));
//   for (const VehicleRoute& route : answer.routes) ...

#include <atomic>
#include <chrono>
#include <cstdint>

#include "supervisor/fleet/allocation/allocation_answer.h"
#include "supervisor/fleet/allocation/allocation_problem.h"

namespace stepwright::fleet {

// Problems with more trips than that are not tried: their answer is Exhausted.
inline constexpr std::uint32_t kMostTrips = 2000;

struct AllocationOptions {
  std::chrono::milliseconds time{0};  // budget of everything; zero = no limit
  std::uint64_t iterations = 2000;    // of large neighbourhood search; zero = until the time is over
  std::uint32_t exact_trips = 10;     // branch and bound up to so many trips, at most 11; zero = never
  std::uint64_t nodes = 2'000'000;    // of branch and bound; zero = no limit
  std::uint64_t seed = 1;
  bool explain = true;                        // name the reason where there is no allocation
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

// Requires indices that are there, amounts and capacities of at least 1, times between 0 and the horizon,
// weights of the objective up to 100,000 and of transports up to 100. That something cannot be reached or
// carried is an answer, not a precondition.
AllocationAnswer allocate(const AllocationProblem& problem, const AllocationOptions& options = {});

}  // namespace stepwright::fleet
