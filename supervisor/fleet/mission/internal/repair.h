#pragma once

// Other paths for vehicles whose paths leave no schedule.
//
// A best-first search over what vehicles keep out of: a set of paths without a schedule is blamed on critical
// sections (Core), and each of the two vehicles of such a section may drive around the place where the other
// one stands, or around all of the section. Sets of paths that are longer by less are tried first. Every set
// that is tried costs a path, an envelope and a schedule, so that their number is bounded.

#include <optional>
#include <vector>

#include "supervisor/fleet/mission/internal/attempt.h"

namespace stepwright::fleet::internal {

struct Repaired {
  std::vector<VehicleMission> missions;
  Schedule schedule;  // the first one found, without an objective
  std::vector<PathChange> changes;
};

struct RepairAnswer {
  std::optional<Repaired> found;
  std::size_t tried = 0;
  bool all_tried = false;  // nothing is left that could be tried
};

// `missions` have no schedule, and `core` is why.
RepairAnswer repair(const Attempt& input, const std::vector<VehicleMission>& missions, const Core& core);

}  // namespace stepwright::fleet::internal
