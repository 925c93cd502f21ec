#pragma once

// Selection of the parts of a problem that are looked at: all of them, or some, while the reason is sought
// for which there is no allocation. A value.

#include <vector>

#include "supervisor/fleet/allocation/allocation_problem.h"

namespace stepwright::fleet::internal {

// By index, 1: looked at. What names a transport that is left out is left out, too.
struct Selection {
  explicit Selection(const AllocationProblem& problem)
      : transports(problem.transports.size(), 1),
        constraints(problem.constraints.size(), 1),
        vehicles(problem.transports.size(), 1),
        orders(problem.orders.size(), 1),
        routes(problem.routes.size(), 1) {}

  std::vector<char> transports;
  std::vector<char> constraints;
  std::vector<char> vehicles;  // of transports: that their vehicle is fixed
  std::vector<char> orders;
  std::vector<char> routes;
};

}  // namespace stepwright::fleet::internal
