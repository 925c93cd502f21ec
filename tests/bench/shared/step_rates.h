#pragma once

// Steps a second of the tank of tests/cells/shared_plant as a plant in C, in Python, as an FMU and in ST,
// beside two processes that send each other one byte and do nothing.
//
// Thread rule: one at a time; it starts processes, and forks.

namespace stepwright::bench_shared {

// 0: it does not run, and stderr says why.
struct StepRates {
  double baseline_turns_per_s = 0.0;
  double c_per_s = 0.0;
  double python_per_s = 0.0;
  double fmu2_step_us = 0.0;
  double fmu3_step_us = 0.0;
  double st_per_s = 0.0;
};

// Each measured for so long; a line for each goes to stdout.
StepRates measure_step_rates(double seconds);

}  // namespace stepwright::bench_shared
