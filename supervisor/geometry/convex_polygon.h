#pragma once

// A convex region of the plane, closed: the footprint of a vehicle, a polygon of a trajectory envelope.
//
// A value that does not change; any thread may read. The corners are in anticlockwise order, at least three,
// no three of them on a line, so that the area is positive.
//
//   const auto box = footprint_at({2.0, 3.0, 0.5}, {.front_m = 2.9, .rear_m = 1.1, .half_width_m = 0.7});
//   if (overlaps(box, other)) ...                // they share inner points; that they touch does not count

#include <optional>
#include <span>
#include <vector>

#include "supervisor/geometry/box.h"
#include "supervisor/geometry/point.h"

namespace stepwright::geometry {

// The points with normal.x * x + normal.y * y <= offset_m: one A x + B y <= C of Pecora and Cirillo 2012,
// definition 1.
struct HalfPlane {
  Point normal;  // of length 1, points outwards
  double offset_m = 0.0;
};

// A rectangle around the reference point of a vehicle, which lies between its sides; all lengths positive.
struct Footprint {
  double front_m = 0.0;  // from the reference point to the front
  double rear_m = 0.0;
  double half_width_m = 0.0;
};

class ConvexPolygon {
 public:
  // The convex hull of the points; nothing where they lie on one line or are not finite.
  static std::optional<ConvexPolygon> hull(std::span<const Point> points);

  std::span<const Point> corners() const { return corners_; }
  const Box& bounds() const { return bounds_; }
  double area_m2() const;
  Point centroid() const;
  // One for each side, from corner k to corner k + 1.
  std::vector<HalfPlane> half_planes() const;
  // Border included; `slack_m` outside of a side still counts.
  bool contains(Point point, double slack_m = 0.0) const;
  bool contains(const ConvexPolygon& inner, double slack_m = 0.0) const;

 private:
  friend ConvexPolygon footprint_at(const Pose& pose, const Footprint& footprint);
  explicit ConvexPolygon(std::vector<Point> corners);

  std::vector<Point> corners_;
  Box bounds_;
};

// Whether the two share inner points (separating axes: Gottschalk, Lin, Manocha 1996, section 4). Regions
// that overlap by less than a nanometre count as touching.
bool overlaps(const ConvexPolygon& a, const ConvexPolygon& b);
// Their common region; nothing where they do not overlap.
std::optional<ConvexPolygon> intersection(const ConvexPolygon& a, const ConvexPolygon& b);

// Requires a finite pose.
ConvexPolygon footprint_at(const Pose& pose, const Footprint& footprint);

}  // namespace stepwright::geometry
