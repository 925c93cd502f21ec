#pragma once

// Pace of the level that an action moves, from the binding's nominal durations: it tells a level that stands
// still, and a sensor that shows the same. Pure functions; any thread.

#include <cstdint>
#include <optional>

#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate::internal {

// Raw counts that are the same for so long have not been read anew. A rest is shorter, and a filter faster.
inline constexpr std::int64_t kStill_us = 2'000'000;

struct Pace {
  const Sensor* sensor = nullptr;  // of the binding
  bool rises = false;              // the counts
  std::int64_t least_counts = 0;   // have to go by
  double within_s = 0.0;           // while the outputs are on
};

// A level that has moved by less than half a unit in the nominal time of three units, 8 s at most, stands
// still. Nothing where the action does not end with a level, the durations do not tell, or the counts are too
// coarse to tell it from standing.
std::optional<Pace> pace_of(const model::PlannedAction& planned, const Binding& binding);

// Whether so many counts go by in kStill_us that a sensor cannot show the same all the while. One that counts
// pieces may.
bool shows_motion(const Sensor& sensor, const model::PlannedAction& planned, const Binding& binding);

}  // namespace stepwright::translate::internal
