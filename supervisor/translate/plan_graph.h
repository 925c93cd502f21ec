#pragma once

// The order in which a plan's actions must run, as a reduced graph. Node i is action i.
//
// Orderings come from the plan; outputs of the binding that exclude each other, or that two actions share,
// add more: of two such actions the one that the list names first runs first.

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate {

// Invariant: transitively reduced; every edge leads to a larger index.
struct PlanGraph {
  std::vector<std::vector<std::size_t>> successors;
  std::vector<std::vector<std::size_t>> predecessors;

  std::size_t size() const { return successors.size(); }
  std::vector<model::Ordering> orderings() const;  // sorted by (before, after)
};

// `edges` must lead to larger indices below `size`.
PlanGraph reduced_graph(std::size_t size, const std::vector<model::Ordering>& edges);

// Two actions that the plan leaves unordered and whose outputs cannot be driven together.
struct Exclusion {
  std::size_t first = 0;  // in the list
  std::size_t second = 0;
  std::vector<std::string> outputs;  // what both drive, or what each drives of a group that excludes
};

// Requires an entry of the binding for every action and orderings that lead to larger indices.
std::vector<Exclusion> exclusions(const model::PlannedRun& run, const Binding& binding);

// The graph of a run under a binding. Fails with T0001 (no entry for an action) or T0002 (an ordering against
// the list).
[[nodiscard]] result::Result<PlanGraph> plan_graph(const model::PlannedRun& run, const Binding& binding,
                                                   bool sequential);

}  // namespace stepwright::translate
