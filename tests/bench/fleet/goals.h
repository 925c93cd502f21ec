#pragma once

// One more goal while a plan runs, with its paths, on several mines and warehouses: on a floor that has found
// no path yet, and on one that has worked out beforehand what it costs to drive to its stations.

#include <cstdint>
#include <vector>

#include "tests/bench/fleet/measure.h"

namespace stepwright::bench::fleet {

struct GoalTimes {
  std::vector<double> total_ms;  // wall time, or CPU time of all threads; by goal
  std::vector<double> paths_ms;  // of it, wall time
  std::uint32_t scheduled = 0;
  std::uint32_t faults = 0;  // of the checker

  double total(double share) const;
};

struct GoalsRow {
  std::uint32_t floors = 0;  // mines and warehouses of which there was a plan
  GoalTimes cold, known;
  double prepare_ms = 0.0;  // of one station, mean; before anything runs
};

// `instances` mines and as many warehouses, seven vehicles each; seven goals each, 30 s after the begin.
GoalsRow measure_goals(std::uint32_t instances, const Settings& settings);
void print(const GoalsRow& row);

}  // namespace stepwright::bench::fleet
