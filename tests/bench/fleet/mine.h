#pragma once

// Seven vehicles in the drawn mine, from goals to scheduled envelopes, with a plainer chain beside it.

#include <string>

#include "tests/bench/fleet/measure.h"

namespace stepwright::bench::fleet {

struct MineRow {
  // The whole: models prepared with a stored look-up table, paths within 1.2 times the least cost, envelopes,
  // schedule in strict mode, other paths where the first ones leave none. Medians of five.
  // With Settings::cpu_time the wholes are CPU time of all threads; parts are wall time always.
  double total_ms = 0.0;
  double prepare_ms = 0.0;
  double paths_ms = 0.0;
  double envelopes_ms = 0.0;
  double schedule_ms = 0.0;
  double repair_ms = 0.0;
  double best_paths_ms = 0.0;  // the whole with A* to the least cost
  std::size_t polygons = 0;
  bool scheduled = false;
  std::uint32_t faults = 0;  // of the checker
  // The baseline: A* with the straight line as its only estimate, the same envelopes without small ends, and
  // the paper's search with O(n^2) closure, in paper mode, which knows no parked vehicles.
  double baseline_ms = 0.0;
  double baseline_paths_ms = 0.0;
  double baseline_envelopes_ms = 0.0;
  double baseline_schedule_ms = 0.0;  // the cap if it came to no end
  bool baseline_timeout = false;
};

MineRow measure_mine(const Settings& settings);
void print(const MineRow& row);

}  // namespace stepwright::bench::fleet
