#pragma once

// A polygon with holes as one ring, for GEOS, whose own joining of holes (3.11) fails for holes that touch or
// line up: a hole that shares a point with the ring goes in at that point, any other over a bridge that is
// passed in both directions (Eberly 2002, "Triangulation by ear clipping").
//
// A pure function; any thread. O(points^2) in the usual case.

#include <functional>
#include <vector>

#include "supervisor/geometry/point.h"

namespace stepwright::ltl {

inline constexpr double kGrid_m = 1e-6;  // all points lie on it

using Ring = std::vector<geometry::Point>;  // does not repeat its first point

// The first ring is the outline, the others are holes in it that lie beside one another; they may touch in
// points. The result is anticlockwise.
// Throws Stopped, which stays inside this folder, when `stop` says so.
struct Stopped {};
using Stop = std::function<bool()>;
Ring single_ring(std::vector<Ring> outline_and_holes, const Stop& stop = {});

}  // namespace stepwright::ltl
