#include "supervisor/fleet/lattice/internal/curve_solver.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>

#include "supervisor/geometry/point.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::Point;

constexpr double kShareOfRadius = 1e-12;  // by how much rounding may take a radius below the least

Point unit(int heading) {
  return {std::cos(heading_rad(heading)), std::sin(heading_rad(heading))};
}

double total_length(const MotionPrimitive& primitive) {
  double length_m = 0.0;
  for (const Segment& segment : primitive.segments) length_m += segment.length_m;
  return length_m;
}

// The end lies `a` metres along the first heading and then `b` along the second. An arc of radius R that
// touches both lines takes R tan(turn / 2) of either; the rest stays straight.
std::optional<MotionPrimitive> turn_to(int heading, int change, GridVector end, const CurveLimits& limits) {
  const Point from = unit(heading);
  const Point to = unit(heading + change);
  const Point goal = limits.resolution_m * Point{double(end.x), double(end.y)};
  const double sine = cross(from, to);
  const double a = cross(goal, to) / sine;
  const double b = cross(from, goal) / sine;
  const double turn = std::atan2(sine, dot(from, to));
  const double tangent = std::tan(0.5 * std::abs(turn));
  const double touching_m = std::min(a, b);
  const double radius_m = touching_m / tangent;
  if (radius_m < limits.min_radius_m * (1.0 - kShareOfRadius)) return std::nullopt;
  MotionPrimitive primitive;
  primitive.start_heading = wrap_heading(heading);
  primitive.end_heading = wrap_heading(heading + change);
  primitive.end = end;
  primitive.segments = {Segment{a - touching_m, 0.0},
                        {radius_m * std::abs(turn), std::copysign(1.0 / radius_m, turn)},
                        {b - touching_m, 0.0}};
  primitive.length_m = total_length(primitive);
  return primitive;
}

// Two arcs of one radius: with the end `ahead` in front and `aside` to the left, each turns by twice the
// angle under which the end is seen.
std::optional<MotionPrimitive> shift_to(int heading, GridVector end, const CurveLimits& limits) {
  const Point direction = unit(heading);
  const Point goal = limits.resolution_m * Point{double(end.x), double(end.y)};
  const double ahead = dot(direction, goal);
  const double aside = cross(direction, goal);
  const double radius_m = (ahead * ahead + aside * aside) / (4.0 * std::abs(aside));
  if (ahead <= 0.0 || radius_m < limits.min_radius_m * (1.0 - kShareOfRadius)) return std::nullopt;
  const double turn = 2.0 * std::atan2(std::abs(aside), ahead);
  const double curvature = std::copysign(1.0 / radius_m, aside);
  MotionPrimitive primitive;
  primitive.start_heading = primitive.end_heading = wrap_heading(heading);
  primitive.end = end;
  primitive.segments = {Segment{radius_m * turn, curvature}, {radius_m * turn, -curvature}, {}};
  primitive.length_m = total_length(primitive);
  return primitive;
}

// Lattice vectors within this many vertices hold the shortest curve: an arc of the least radius, and a vertex
// beyond it in each direction.
int search_range(const CurveLimits& limits) {
  return static_cast<int>(std::ceil(2.0 * limits.min_radius_m / limits.resolution_m)) + 8;
}

}  // namespace

MotionPrimitive solve_turn(int heading, int change, const CurveLimits& limits) {
  // The end is a whole number of steps along both headings or between such points; all are tried.
  const int range = search_range(limits);
  std::optional<MotionPrimitive> best;
  for (int x = -range; x <= range; ++x) {
    for (int y = -range; y <= range; ++y) {
      auto primitive = turn_to(heading, change, {x, y}, limits);
      if (primitive && (!best || primitive->length_m < best->length_m - 1e-9)) best = primitive;
    }
  }
  assert(best.has_value());
  return *best;
}

MotionPrimitive solve_shift(int heading, bool to_the_left, const CurveLimits& limits) {
  const GridVector along = heading_vector(heading);
  const int range = search_range(limits);
  std::optional<MotionPrimitive> best;
  for (int x = -range; x <= range; ++x) {
    for (int y = -range; y <= range; ++y) {
      // Vertices lie on lines parallel to the heading; this product counts them.
      if (along.x * y - along.y * x != (to_the_left ? 1 : -1)) continue;
      auto primitive = shift_to(heading, {x, y}, limits);
      if (primitive && (!best || primitive->length_m < best->length_m - 1e-9)) best = primitive;
    }
  }
  assert(best.has_value());
  return *best;
}

MotionPrimitive straight_line(int heading, int steps, const CurveLimits& limits) {
  MotionPrimitive primitive;
  primitive.start_heading = primitive.end_heading = wrap_heading(heading);
  primitive.end = steps * heading_vector(heading);
  primitive.length_m = limits.resolution_m * std::hypot(primitive.end.x, primitive.end.y);
  primitive.segments[0] = {primitive.length_m, 0.0};
  return primitive;
}

}  // namespace stepwright::fleet::internal
