#pragma once

// The reach of an arm in the few numbers that a controller compares a pose with (REACH_BOUNDS of
// ladder/driver/library/reach_check.st): a shoulder, a box for the tool, and rings, distances from the
// shoulder seen from above with turns of the tool, seen from the direction in which it lies. Outer bounds as
// what they are made of: whatever that does not exclude is within.
//
// Functions without state; any thread.
//
//   const ReachRings rings = rings_of(*cell.arms[0].reach, shoulder);
//   write("left.st", reach_block("left", rings));

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "supervisor/tamp/intervals/reach/reach_bounds.h"

namespace stepwright::tamp {

// Metres and radians; both ends included.
struct ReachRing {
  double least_m = 0.0, most_m = 0.0;       // from the shoulder, seen from above
  double middle_rad = 0.0, half_rad = 0.0;  // of the tool's angle, less its bearing from the shoulder
};

struct ReachRings {
  static constexpr std::size_t kMost = 16;  // of a block

  Shoulder shoulder;
  double least_m = 0.0, most_m = 0.0;       // from shoulder to wrist; both 0: nothing is reached
  std::array<double, 3> low_m{}, high_m{};  // of the tool
  std::vector<ReachRing> rings;
};

// `distances` parts from the least distance seen from above to the most, at most two ranges of turns in each.
// Requires 1 to kMost / 2.
ReachRings rings_of(const ReachBounds& reach, const Shoulder& shoulder,
                    std::size_t distances = ReachRings::kMost / 2);

// A function block of Structured Text, NAME_REACH (made a legal name), that calls REACH_CHECK with
// these bounds.
std::string reach_block(const std::string& arm, const ReachRings& rings);

}  // namespace stepwright::tamp
