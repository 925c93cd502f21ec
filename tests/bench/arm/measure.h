#pragma once

// Ours on a set of problems: what is valid, what is solved, how long it takes, and every path looked at
// again.

#include <cstddef>
#include <string>
#include <vector>

#include "supervisor/motion/path/certain_path.h"
#include "tests/bench/arm/problem_sets.h"

namespace stepwright::bench {

struct OwnFigures {
  std::size_t problems = 0, valid = 0, solved = 0;
  std::size_t by_ways = 0, by_bodies = 0;  // solved with help of the bodies
  std::size_t collisions = 0;         // of the paths returned, looked at again: as a whole, and in places
  std::vector<std::string> unsolved;  // of the valid ones
  std::vector<double> first_ms;       // the first path on spheres, of those whose ends spheres allow
  std::vector<double> shortened_ms;   // and shortened
  std::vector<double> certain_ms;     // all: spheres made, planned, shortened, judged by the bodies
  std::vector<std::size_t> measured;  // numbers of the problems that first_ms is of
};
// Milliseconds of the processor.
OwnFigures measure_ours(const ProblemSet& set);

double quantile(std::vector<double> values, double share);

}  // namespace stepwright::bench
