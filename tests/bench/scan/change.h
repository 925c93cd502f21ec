#pragma once

// Cost of an online change for the scan: 100 changes to and fro between two programs with 10,000 variables,
// in real time at 1 ms. Every variable lies elsewhere in the other program. Beside it the baseline: the scans
// that an equally long run of the same program in the same process misses without a change, and a thread of
// the same priority that only counts for as long as the median pause: what the machine takes from anyone.
//
//   const ChangeFigures figures = measure_changes();
//   print(figures);

#include <cstdint>

namespace stepwright::bench {

struct ChangeFigures {
  std::uint32_t variables = 0;
  std::uint32_t changes = 0;
  double pause_p50_us = 0.0;  // by which a change makes the scan thread later
  double pause_p90_us = 0.0;
  double pause_max_us = 0.0;
  std::uint32_t over_goal = 0;       // changes with a pause above 50 us
  double bare_max_us = 0.0;          // the worst of as many pieces of bare work as long as the median pause
  std::uint32_t bare_over_goal = 0;  // of them, above 50 us
  double prepared_p50_ms = 0.0;      // beside the running program: verified, engine made, transfer planned
  std::uint64_t scans = 0;           // while the programs were changed
  std::uint64_t missed = 0;          // of them
  std::uint64_t baseline_scans = 0;
  std::uint64_t baseline_missed = 0;
};

// Aborts the process with a message if something does not run.
ChangeFigures measure_changes();

void print(const ChangeFigures& figures);

}  // namespace stepwright::bench
