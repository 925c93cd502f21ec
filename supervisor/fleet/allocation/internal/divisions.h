#pragma once

// Divisions of loads into trips. What fixed routes take of a transport are trips already; the rest of it is
// divided into full loads of vehicles that may take it, and at most one trip that is less.
//
// Pure functions; any thread.
//
// Where a vehicle has one transport aboard at a time nothing better is lost by that: amounts can be moved
// between the trips of any allocation until all but one are full, and empty ones left out.

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/allocation/internal/selection.h"

namespace stepwright::fleet::internal {

using Amounts = std::vector<std::uint32_t>;  // of trips, the largest first

// By transport: what is left to divide; nothing if fixed routes take all, or more than there is.
Amounts undivided(const AllocationProblem& problem, const Selection& selection);

// No division of what is selected has fewer trips, but for those of fixed routes.
std::uint64_t fewest_trips(const AllocationProblem& problem, const Selection& selection);

struct Divisions {
  std::vector<Amounts> all;  // fewest trips first; the first one loads the largest vehicles
  bool complete = true;      // false: there are more
};

// Of what is left of one transport. If it is indivisible or no vehicle may take it: one trip with all of it.
Divisions divisions(const AllocationProblem& problem, const Selection& selection, std::uint32_t transport,
                    std::uint32_t amount);

// One division of each transport.
using Division = std::vector<Amounts>;

// Every choice of one division for each transport, fewest trips first, with at most `most_trips` trips.
struct JointDivisions {
  std::vector<Division> all;  // at least one, however many trips that has
  bool complete = true;
};
JointDivisions joint_divisions(const AllocationProblem& problem, const Selection& selection,
                               std::size_t most_trips);

// A few for problems whose divisions cannot all be tried: all transports into full loads of the largest
// vehicles, or of those of each other capacity, or of one by turns.
JointDivisions usual_divisions(const AllocationProblem& problem, const Selection& selection);

}  // namespace stepwright::fleet::internal
