#pragma once

// The outline of what several convex regions cover together.
//
// A pure function; any thread.
//
//   for (const auto& ring : union_outlines(pieces, 0.01)) draw(ring);   // filled by the nonzero rule

#include <span>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::geometry {

// Closed lines, each without its first point once more: anticlockwise around what is covered, clockwise
// around a hole in it. Points that lie within `tolerance_m` of the line through the others are left out, and
// so are parts and holes that are no wider than that.
std::vector<std::vector<Point>> union_outlines(std::span<const ConvexPolygon> regions, double tolerance_m);

}  // namespace stepwright::geometry
