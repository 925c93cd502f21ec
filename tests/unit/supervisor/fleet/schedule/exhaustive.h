#pragma once

// The oracle of the scheduler's tests: tries both orders of every single pair of overlapping polygons, with
// constraints written down from the definitions and consistency by Bellman and Ford. It knows no sections.

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/schedule/sections.h"
#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet {

struct Exhaustive {
  bool feasible = false;
  std::int64_t makespan_ms = 0;   // the least
  std::int64_t tardiness_ms = 0;  // the least, with all vehicles due at `due`
  std::size_t pairs = 0;
};

// Only pairs in `only`, where it is given, need an order.
Exhaustive try_all_orders(const Problem& problem, Mode mode, std::int64_t due_ms,
                          const std::vector<SpatialPair>* only = nullptr);

}  // namespace stepwright::fleet
