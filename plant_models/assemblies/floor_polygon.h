#pragma once

// Boxes against simple polygons, exactly: whether they share inner points, how far apart they are, and
// whether a point lies within. Metres, seen from above.
//
// Pure functions of values; any thread. No heap. What overlaps by less than a nanometre touches, and does not
// overlap.
//
//   const FloorOutline outline(polygon);
//   if (meets(box, outline, Solid::Inside)) ...     // an obstacle
//   if (meets(box, border, Solid::Outside)) ...     // the walls around a hall

#include <cstdint>
#include <string>
#include <vector>

#include "plant_models/body2d/body_geometry.h"

namespace stepwright::assemblies {

// A simple polygon in either order, without its first point once more.
struct FloorPolygon {
  std::string name;
  std::vector<body2d::Vec2> ring;
};

// A rectangle that lies somewhere and some way.
struct PlacedBox {
  body2d::Vec2 middle;
  body2d::Vec2 ahead{1.0, 0.0};  // of length 1
  double half_length_m = 0.0;    // along `ahead`
  double half_width_m = 0.0;

  body2d::Area bounds() const;
};

// A polygon with what is looked at before its sides are.
class FloorOutline {
 public:
  explicit FloorOutline(std::vector<body2d::Vec2> ring);

  const std::vector<body2d::Vec2>& ring() const { return ring_; }
  const body2d::Area& bounds() const { return bounds_; }
  // Even-odd rule; which side a point of the outline itself is on is not promised.
  bool contains(body2d::Vec2 point) const;

 private:
  std::vector<body2d::Vec2> ring_;
  body2d::Area bounds_;
};

// Which side of an outline nothing passes.
enum class Solid : std::uint8_t { Inside, Outside };

bool meets(const PlacedBox& box, const FloorOutline& outline, Solid solid);
bool meets(const PlacedBox& a, const PlacedBox& b);

// The distance of the box to the nearest side of the outline, if it is less than `below_m`; else `below_m`.
// Requires a box that no side crosses.
double distance_m(const PlacedBox& box, const FloorOutline& outline, double below_m);

// The corners of a rectangle of that length (along the angle) and width.
std::vector<body2d::Vec2> rectangle_ring(const body2d::Pose& pose, double length_m, double width_m);

// At least three corners, all of them finite, no two sides that meet but at the corner that they share.
bool is_simple(const std::vector<body2d::Vec2>& ring);

}  // namespace stepwright::assemblies
