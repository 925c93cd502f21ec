#pragma once

// Rounds the corners of a path: a quartic around each way-point, within a tolerance and within what a check
// allows (doc: supervisor/doc/motion_timing.md).
//
//   const auto free = [&](const JointPath& chords) { return all motions of chords are free; };
//   const auto path = blend(way_points, {.tolerance = 0.05}, free);
//   if (!path) ... to_string(path.error()) ...
//
// A function without state; any thread; the same on every machine.

#include <functional>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/blend/blended_path.h"

namespace stepwright::motion {

struct BlendOptions {
  double tolerance = 0.05;  // no joint leaves the polyline by more, rad (m)
  int most_halvings = 6;    // of the tolerance of a corner where the check refuses; then the arm stops there
  int chords = 16;          // a blend is shown to the check as so many straight motions
};

// Whether a blend may be: way-points on it, its ends among them. The blend leaves the chords between them by
// at most 1/100 of its own distance from the corner (with 16 chords).
using BlendCheck = std::function<bool(const JointPath& chords)>;

// Errors A0501 to A0505; those of way-points say which ones.
[[nodiscard]] result::Result<BlendedPath> blend(const JointPath& way_points, const BlendOptions& options = {},
                                                const BlendCheck& check = {});

// What blend() refuses of way-points, without blending.
[[nodiscard]] result::Result<void> check_way_points(const JointPath& way_points);

}  // namespace stepwright::motion
