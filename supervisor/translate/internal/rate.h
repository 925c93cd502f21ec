#pragma once

// How fast a sensor's counts may change. Counts that rise by r a second are r times the filter's time
// constant above the filtered ones, so their distance tells the rate without a memory; a leap is there at
// once and fades with the filter. Noise may add the sensor's tolerance.
//
// Pure functions.

#include "supervisor/translate/binding.h"

namespace stepwright::translate::internal {

// The greatest distance between counts and filtered counts of a sound sensor, from its `max_rate`; where the
// calibration has several lines, on the steepest one.
double most_counts_from_filtered(const Sensor& sensor);

}  // namespace stepwright::translate::internal
