#pragma once

// Sides and outlines of any polygon: what is nearest on a side, how far it is, and which way round an outline
// goes. Pure functions.

#include <algorithm>
#include <cstddef>
#include <span>

#include "supervisor/geometry/point.h"

namespace stepwright::geometry {

// The point of the side from `from` to `to` that is nearest to `at`.
inline Point nearest_on_side(Point from, Point to, Point at) {
  const Point along = to - from;
  const double square = dot(along, along);
  const double share = square > 0.0 ? std::clamp(dot(at - from, along) / square, 0.0, 1.0) : 0.0;
  return from + share * along;
}

inline double distance_to_side(Point at, Point from, Point to) {
  return distance(at, nearest_on_side(from, to, at));
}

// Positive where the corners are in anticlockwise order. Requires at least one.
inline double signed_area_m2(std::span<const Point> ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice += cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
  return 0.5 * twice;
}

}  // namespace stepwright::geometry
