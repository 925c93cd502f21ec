#include "plant_models/assemblies/floor_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace stepwright::assemblies {
namespace {

using body2d::Area;
using body2d::Vec2;

constexpr double kTouching_m = 1e-9;

double dot_of(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}

// In the axes of the box.
Vec2 own(const PlacedBox& box, Vec2 point) {
  const Vec2 way = point - box.middle;
  return {dot_of(box.ahead, way), body2d::cross(box.ahead, way)};
}

std::array<Vec2, 4> corners(const PlacedBox& box) {
  const Vec2 along = box.half_length_m * box.ahead;
  const Vec2 aside = box.half_width_m * Vec2{-box.ahead.y, box.ahead.x};
  return {box.middle + along + aside, box.middle - along + aside, box.middle - along - aside,
          box.middle + along - aside};
}

// How far the two areas are apart along the axes, or less than 0.
double apart_m(const Area& a, const Area& b) {
  return std::max({a.low.x - b.high.x, b.low.x - a.high.x, a.low.y - b.high.y, b.low.y - a.high.y});
}

Area around(Vec2 a, Vec2 b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

// Cuts [from, to] of the way start + t * step down to where it lies within +-half.
bool cut(double start, double step, double half, double& from, double& to) {
  if (step == 0.0) return std::abs(start) < half;
  const double a = (-half - start) / step;
  const double b = (half - start) / step;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
  return from < to;
}

bool side_crosses(const PlacedBox& box, Vec2 a, Vec2 b) {
  const Vec2 start = own(box, a);
  const Vec2 step = own(box, b) - start;
  double from = 0.0;
  double to = 1.0;
  return cut(start.x, step.x, box.half_length_m - kTouching_m, from, to) &&
         cut(start.y, step.y, box.half_width_m - kTouching_m, from, to);
}

double distance_to_side(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const Vec2 way = point - from;
  const double square = dot_of(along, along);
  const double part = square > 0.0 ? std::clamp(dot_of(way, along) / square, 0.0, 1.0) : 0.0;
  return body2d::length(way - part * along);
}

double distance_to_box(const PlacedBox& box, Vec2 point) {
  const Vec2 at = own(box, point);
  return std::hypot(std::max(std::abs(at.x) - box.half_length_m, 0.0),
                    std::max(std::abs(at.y) - box.half_width_m, 0.0));
}

// Whether an axis of `a` keeps the two apart.
bool separated_by(const PlacedBox& a, const PlacedBox& b) {
  const Vec2 way = own(a, b.middle);
  const double along = std::abs(dot_of(a.ahead, b.ahead));
  const double across = std::abs(body2d::cross(a.ahead, b.ahead));
  return std::abs(way.x) >=
             a.half_length_m + b.half_length_m * along + b.half_width_m * across - kTouching_m ||
         std::abs(way.y) >= a.half_width_m + b.half_length_m * across + b.half_width_m * along - kTouching_m;
}

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return body2d::cross(b - a, c - a);
}

bool on_side(Vec2 a, Vec2 b, Vec2 point) {
  return turn(a, b, point) == 0.0 && around(a, b).contains(point);
}

bool sides_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (apart_m(around(a, b), around(c, d)) > 0.0) return false;
  const double ac = turn(a, b, c);
  const double ad = turn(a, b, d);
  const double ca = turn(c, d, a);
  const double cb = turn(c, d, b);
  if (((ac > 0.0 && ad < 0.0) || (ac < 0.0 && ad > 0.0)) &&
      ((ca > 0.0 && cb < 0.0) || (ca < 0.0 && cb > 0.0)))
    return true;
  return on_side(a, b, c) || on_side(a, b, d) || on_side(c, d, a) || on_side(c, d, b);
}

}  // namespace

Area PlacedBox::bounds() const {
  const double x = half_length_m * std::abs(ahead.x) + half_width_m * std::abs(ahead.y);
  const double y = half_length_m * std::abs(ahead.y) + half_width_m * std::abs(ahead.x);
  return {{middle.x - x, middle.y - y}, {middle.x + x, middle.y + y}};
}

FloorOutline::FloorOutline(std::vector<Vec2> ring) : ring_(std::move(ring)) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  bounds_ = {{kFar, kFar}, {-kFar, -kFar}};
  for (const Vec2 each : ring_) {
    bounds_.low = {std::min(bounds_.low.x, each.x), std::min(bounds_.low.y, each.y)};
    bounds_.high = {std::max(bounds_.high.x, each.x), std::max(bounds_.high.y, each.y)};
  }
}

bool FloorOutline::contains(Vec2 point) const {
  if (!bounds_.contains(point)) return false;
  bool inside = false;
  Vec2 before = ring_.back();
  for (const Vec2 each : ring_) {
    // To the left of the point, and on its height: the upper end of a side is not of the side.
    if ((before.y > point.y) != (each.y > point.y)) {
      const bool upwards = each.y > before.y;
      if ((turn(before, each, point) > 0.0) == upwards) inside = !inside;
    }
    before = each;
  }
  return inside;
}

bool meets(const PlacedBox& box, const FloorOutline& outline, Solid solid) {
  const Area bounds = box.bounds();
  if (apart_m(bounds, outline.bounds()) < 0.0) {
    Vec2 before = outline.ring().back();
    for (const Vec2 each : outline.ring()) {
      if (apart_m(bounds, around(before, each)) <= 0.0 && side_crosses(box, before, each)) return true;
      before = each;
    }
  }
  return outline.contains(box.middle) == (solid == Solid::Inside);
}

bool meets(const PlacedBox& a, const PlacedBox& b) {
  return apart_m(a.bounds(), b.bounds()) < 0.0 && !separated_by(a, b) && !separated_by(b, a);
}

double distance_m(const PlacedBox& box, const FloorOutline& outline, double below_m) {
  const Area bounds = box.bounds();
  if (apart_m(bounds, outline.bounds()) >= below_m) return below_m;
  const auto own_corners = corners(box);
  double least = below_m;
  Vec2 before = outline.ring().back();
  for (const Vec2 each : outline.ring()) {
    if (apart_m(bounds, around(before, each)) < least) {
      least = std::min(least, distance_to_box(box, each));
      for (const Vec2 corner : own_corners) least = std::min(least, distance_to_side(corner, before, each));
    }
    before = each;
  }
  return least;
}

std::vector<Vec2> rectangle_ring(const body2d::Pose& pose, double length_m, double width_m) {
  const auto placed =
      corners({pose.position, {std::cos(pose.angle), std::sin(pose.angle)}, 0.5 * length_m, 0.5 * width_m});
  return {placed.begin(), placed.end()};
}

bool is_simple(const std::vector<Vec2>& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  for (const Vec2 each : ring) {
    if (!std::isfinite(each.x) || !std::isfinite(each.y)) return false;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = ring[i];
    const Vec2 b = ring[(i + 1) % n];
    // The next side goes on from this one, and not back along it.
    const Vec2 c = ring[(i + 2) % n];
    if (a == b || on_side(a, b, c) || on_side(b, c, a)) return false;
    for (std::size_t k = i + 2; k < n; ++k) {
      const bool neighbours = i == 0 && k == n - 1;
      if (!neighbours && sides_meet(a, b, ring[k], ring[(k + 1) % n])) return false;
    }
  }
  return true;
}

}  // namespace stepwright::assemblies
