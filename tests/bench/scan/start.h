#pragma once

// Time until a killed runtime is back: from the start of the process to its first scan, with 1000 rungs and 5
// KB of retained values in 2000 variables, and how much memory it then holds; beside it the start of a
// process that does nothing.
//
//   const StartFigures figures = measure_start();
//   out["first_scan_ms"] = figures.first_scan_ms;

namespace stepwright::bench {

struct StartFigures {
  double first_scan_ms = 0.0;      // median; until a client has the event of the first scan
  double first_scan_max_ms = 0.0;  // of all starts
  double bare_process_ms = 0.0;    // median of fork, exec and end of /bin/true
  double resident_mb = 0.0;        // of the runtime after a second of scans
};

// Ends the process if the runtime cannot be started.
StartFigures measure_start();

}  // namespace stepwright::bench
