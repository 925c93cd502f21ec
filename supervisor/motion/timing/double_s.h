#pragma once

// The shortest motion of one axis from a speed to rest: the double S, of at most seven phases with a constant
// jerk each.
//
//   const auto rows = double_s(1.2, 0.0, {.velocity = 1, .acceleration = 5, .jerk = 50});
//
// Functions without state; any thread; the same on every machine. With a start speed within the limit nothing
// is shorter within the limits; with a start speed above it (an override that was lowered) the axis first
// slows down to the limit as fast as it may, where there is room for it.

#include <optional>
#include <vector>

#include "supervisor/motion/timing/limits.h"
#include "supervisor/motion/timing/time_law.h"

namespace stepwright::motion {

// Rows from place 0 to `length`, without acceleration at both ends. Nothing: the axis cannot stop within
// `length` (stopping_distance). Requires a length above 0, a start speed from 0 on and limits above 0.
std::optional<std::vector<TimeRow>> double_s(double length, double start_speed, const AxisLimits& limits);

// From a speed to rest, the acceleration being 0 at both ends.
double stopping_distance(double speed, const AxisLimits& limits);

}  // namespace stepwright::motion
