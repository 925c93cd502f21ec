#pragma once

// Bounds of the time that a vehicle takes for a stretch of its path (Pecora and Cirillo 2012, "Temporal
// envelope generation"). Pure functions.
//
//   time_bounds(3.0, {.min_mps = 0.05, .max_mps = 1.5})  // 2000 ms to 60000 ms

#include <chrono>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/envelope/trajectory_envelope.h"

namespace stepwright::fleet {

struct SpeedLimits {
  double min_mps = 0.05;  // 0: it may stop
  double max_mps = 1.5;
  std::chrono::milliseconds horizon{100'000'000};  // nothing takes longer
};

// F0502 names the key behind `prefix` (min_mps, max_mps) whose value is no speed or contradicts the other's.
result::Diagnostics check(const SpeedLimits& limits, const result::Location& where, std::string_view prefix);

// In whole milliseconds, rounded inwards: a schedule that keeps the bounds never asks for more than the
// largest nor for less than the smallest mean speed. (Rounded outwards, the earliest schedule would have a
// vehicle leave up to a millisecond before it can, and others count on that.) Where no whole millisecond lies
// between, both are the least that the vehicle can do. Requires limits that `check` accepts and a length of
// at least 0.
Bounds time_bounds(double length_m, const SpeedLimits& limits);

}  // namespace stepwright::fleet
