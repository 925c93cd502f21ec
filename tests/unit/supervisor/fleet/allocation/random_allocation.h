#pragma once

// Small allocation problems at random: ways that are missing, one-way or longer than by way of others, loads
// that must be divided, windows, couplings, parts fixed by hand.

#include <cstdint>
#include <random>

#include "supervisor/fleet/allocation/allocation_problem.h"

namespace stepwright::fleet {

struct DrawnSize {
  std::uint32_t vehicles = 2;
  std::uint32_t transports = 3;
  std::uint32_t most_amount = 2;
  bool constraints = true;
  bool fixed = true;
};

AllocationProblem draw_allocation(const DrawnSize& size, std::mt19937& random);

}  // namespace stepwright::fleet
