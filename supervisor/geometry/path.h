#pragma once

// Path of a vehicle: poses in the order in which it takes them. A value; planners make one, people may draw
// or record one.
//
//   const Path path{{{0, 0, 0}, 0.0, Travel::Forward}, {{0.1, 0, 0}, 0.1, Travel::Forward}};

#include <cstdint>
#include <vector>

#include "supervisor/geometry/point.h"

namespace stepwright::geometry {

enum class Travel : std::uint8_t { Forward, Reverse };

struct PathPose {
  Pose pose;
  double arc_m = 0.0;               // length of the way from the first pose; never falls
  Travel travel = Travel::Forward;  // how the vehicle came here; in the first pose, how it leaves
};

using Path = std::vector<PathPose>;

}  // namespace stepwright::geometry
