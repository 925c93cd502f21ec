#pragma once

// Cost of a plan's monitors (supervisor/translate/monitors.h) in every scan: the tank bench's plan compiled
// with and without them, both run over the inputs of one recorded run, taking turns.
//
//   const MonitorFigures figures = measure_monitors(EngineKind::Native);
//   figures.ratio()   // of the means over all scans

#include <cstddef>

#include "tests/support/engine_program/engine_program.h"

namespace stepwright::bench {

using support::EngineKind;

struct MonitorFigures {
  std::size_t scans = 0;
  std::size_t monitors = 0;  // rungs that can raise an alarm
  double with_us = 0.0;      // mean of a scan; of the passes over the run the median
  double without_us = 0.0;
  double with_bytes = 0.0;  // of code that a scan enters (bytecode/engine.h), mean: the same on every machine
  double without_bytes = 0.0;

  double ratio() const { return with_us / without_us; }
};

// Throws std::runtime_error if the plan cannot be made, or if the two programs do not drive the same outputs.
// `passes` over the run for the times; 0 leaves them out.
MonitorFigures measure_monitors(EngineKind engine, int passes = 11);

}  // namespace stepwright::bench
