#pragma once

// Measured cost of a plant that is described by components: the tank bench beside the built-in one, and
// plants of 10, 100 and 1000 components.

#include <string>
#include <vector>

#include "tests/bench/plant/bench_job.h"

namespace stepwright::bench {

struct ModelFigures {
  double us = 0.0;  // per scan of 10 ms, through the port driver
  double largest_level_error_percent = 0.0;
  double realtime_factor = 0.0;
};

// The recorded job on the bench of tests/cells/bench_model.
ModelFigures measure_model(const std::vector<Outputs>& job, int repeats);

struct Growth {
  std::size_t components = 0;
  std::size_t states = 0;
  double load_ms = 0.0;
  double scan_us = 0.0;
  double realtime_factor = 0.0;
  double implicit_scan_us = 0.0;
};

// A row of tanks, each of which runs into the next one through a pipe, with a level sensor at every fourth.
Growth measure_row(std::size_t components);

// Types in the library.
std::size_t library_size();

}  // namespace stepwright::bench
