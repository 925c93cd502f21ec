#pragma once

// The baselines: SolveESTA of Pecora and Cirillo 2012, chronological backtracking over pairs of polygons that
// overlap in space and in the earliest times, on a full matrix of distances.
//
//   variable ordering h_var: the conflict with the smallest sum of distances to all other conflicts, each at
//   the middle between its polygons' centroids; value ordering h_val: the order that leaves more slack
//   (Cesta, Oddi, Smith 2002) is tried first.
//
// Closure::FloydWarshall propagates as the paper says, all pairs afresh for every constraint posted.
// Closure::Incremental adds a constraint in O(n^2). Both take a constraint back by restoring a saved matrix,
// and both find spatial overlaps once before the search: in that they are better than what was published.

#include <time.h>

#include <cstdint>
#include <vector>

#include "supervisor/fleet/schedule/schedule.h"
#include "tests/bench/fleet/instance.h"

namespace stepwright::bench::fleet {

enum class Closure : std::uint8_t { FloydWarshall, Incremental };
enum class Found : std::uint8_t { Schedule, None, TimeOut };

struct EstaResult {
  Found found = Found::TimeOut;
  std::uint64_t nodes = 0;      // constraints tried
  std::uint64_t resolvers = 0;  // constraints that were posted at the end
  std::vector<std::vector<stepwright::fleet::PolygonTimes>> earliest;
};

// By the clock that the run is measured with: on a busy machine wall time would end it before its time.
struct Cap {
  clockid_t clock = CLOCK_MONOTONIC;
  double seconds = 60.0;
};

EstaResult solve_esta(const Instance& instance, Closure closure, const Cap& cap);

}  // namespace stepwright::bench::fleet
