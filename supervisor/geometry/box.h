#pragma once

// Boxes along the axes: what points and outlines lie within. Values.
//
//   Box box = kNoBox;
//   for (const Point each : outline) extend(box, each);

#include <algorithm>
#include <limits>
#include <span>

#include "supervisor/geometry/point.h"

namespace stepwright::geometry {

struct Box {
  Point low;
  Point high;
};

// Of no points: any point extends it to itself.
inline constexpr Box kNoBox{
    {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
    {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}};

inline void extend(Box& box, Point at) {
  box.low = {std::min(box.low.x_m, at.x_m), std::min(box.low.y_m, at.y_m)};
  box.high = {std::max(box.high.x_m, at.x_m), std::max(box.high.y_m, at.y_m)};
}

inline Box bounds_of(std::span<const Point> points) {
  Box box = kNoBox;
  for (const Point each : points) extend(box, each);
  return box;
}

}  // namespace stepwright::geometry
