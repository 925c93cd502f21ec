#pragma once

// Judges allocations without the allocator: whether loads, capacities, ways, times and everything that is
// fixed are as the problem says, and whether the objective is what the routes come to. It reads nothing that
// the allocator computed but its answer. Pure functions.
//
//   for (const std::string& fault : faults_of(answer, problem)) ...

#include <string>
#include <vector>

#include "supervisor/fleet/allocation/allocation_answer.h"

namespace stepwright::fleet {

// One sentence for each fault of an answer with routes; empty if all is well.
std::vector<std::string> faults_of(const AllocationAnswer& answer, const AllocationProblem& problem);

}  // namespace stepwright::fleet
