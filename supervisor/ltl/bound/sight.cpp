#include "supervisor/ltl/bound/sight.h"

#include <algorithm>
#include <cmath>

#include "supervisor/geometry/outline.h"
#include "supervisor/ltl/scene/places.h"

namespace stepwright::ltl {

using geometry::Point;

namespace {

constexpr double kTouch_m = 2e-6;   // outlines are known to a micrometre
constexpr double kBeside_m = 2e-5;  // of a way that leads along outlines

}  // namespace

Sight::Outline Sight::outline_of(const std::vector<Point>& ring) {
  Outline made{ring, geometry::bounds_of(ring)};
  if (geometry::signed_area_m2(made.ring) < 0.0) std::ranges::reverse(made.ring);
  return made;
}

Sight::Sight(const Floor& floor) : border_(outline_of(floor.border.ring)) {
  for (const Area& each : floor.obstacles) obstacles_.push_back(outline_of(each.ring));
  for (const Area& each : floor.propositions) places_.push_back(outline_of(each.ring));
  add_corners(border_, true);
  for (const Outline& each : obstacles_) add_corners(each, false);
  for (const Outline& each : places_) add_corners(each, false);
}

void Sight::add_corners(const Outline& outline, bool hole) {
  const std::size_t count = outline.ring.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Point before = outline.ring[(k + count - 1) % count], at = outline.ring[k];
    const double turn = cross(at - before, outline.ring[(k + 1) % count] - at);
    if (hole ? turn > 0.0 : turn < 0.0) continue;
    if (lies_within(border_, at, true)) continue;
    const bool covered = std::ranges::any_of(obstacles_, [&](const Outline& each) {
      return !apart(each, at, at) && lies_within(each, at, false);
    });
    if (!covered) corners_.push_back(at);
  }
}

bool Sight::apart(const Outline& outline, Point a, Point b) {
  return std::max(a.x_m, b.x_m) < outline.bounds.low.x_m ||
         std::min(a.x_m, b.x_m) > outline.bounds.high.x_m ||
         std::max(a.y_m, b.y_m) < outline.bounds.low.y_m || std::min(a.y_m, b.y_m) > outline.bounds.high.y_m;
}

// Inside, or beyond it; not where it is the outline itself.
bool Sight::lies_within(const Outline& outline, Point at, bool beyond) {
  if (inside(outline.ring, at) == beyond) return false;
  for (std::size_t k = 0, before = outline.ring.size() - 1; k < outline.ring.size(); before = k++)
    if (distance_to_side(at, outline.ring[before], outline.ring[k]) <= kTouch_m) return false;
  return true;
}

// Where it may enter and leave: its own ends, and what it touches. False where it crosses a side for certain.
bool Sight::cut(const Outline& outline, const Way& way, std::vector<double>& cuts_m) {
  const auto same_side = [](double a_m, double b_m) {
    return (a_m > kTouch_m && b_m > kTouch_m) || (a_m < -kTouch_m && b_m < -kTouch_m);
  };
  const auto parted = [](double a_m, double b_m) {
    return std::min(a_m, b_m) < -kTouch_m && std::max(a_m, b_m) > kTouch_m;
  };
  for (std::size_t k = 0, before = outline.ring.size() - 1; k < outline.ring.size(); before = k++) {
    const Point c = outline.ring[before], d = outline.ring[k], side = d - c;
    const double c_off_m = cross(way.along, c - way.from), d_off_m = cross(way.along, d - way.from);
    if (same_side(c_off_m, d_off_m)) continue;
    const double side_m = std::max(std::hypot(side.x_m, side.y_m), 1e-9);
    const double from_off_m = cross(side, way.from - c) / side_m;
    const double to_off_m = cross(side, way.to - c) / side_m;
    if (same_side(from_off_m, to_off_m)) continue;
    if (parted(c_off_m, d_off_m) && parted(from_off_m, to_off_m)) return false;
    cuts_m.push_back(0.0);
    if (std::abs(c_off_m) <= kTouch_m) cuts_m.push_back(dot(way.along, c - way.from));
    if (std::abs(d_off_m) <= kTouch_m) cuts_m.push_back(dot(way.along, d - way.from));
  }
  return true;
}

// Whether it is open beside each part of the way, on one side of it at least.
template <typename Open>
bool Sight::open_beside(const Way& way, std::vector<double>& cuts_m, const Open& open) {
  if (cuts_m.empty()) return true;
  cuts_m.push_back(way.length_m);
  std::ranges::sort(cuts_m);
  const Point aside{-kBeside_m * way.along.y_m, kBeside_m * way.along.x_m};
  for (std::size_t k = 1; k < cuts_m.size(); ++k) {
    if (cuts_m[k - 1] < 0.0 || cuts_m[k] > way.length_m || cuts_m[k] - cuts_m[k - 1] < kBeside_m) continue;
    const Point middle = way.from + (0.5 * (cuts_m[k - 1] + cuts_m[k])) * way.along;
    if (!open(middle + aside) && !open(middle - aside)) return false;
  }
  return true;
}

bool Sight::is_free(Point at) const {
  return inside(border_.ring, at) && std::ranges::none_of(obstacles_, [&](const Outline& each) {
           return !apart(each, at, at) && inside(each.ring, at);
         });
}

std::optional<Label> Sight::through(Point from, Point to) const {
  const double length_m = geometry::distance(from, to);
  if (length_m <= kTouch_m) return Label{0};
  const Way way{from, to, (1.0 / length_m) * (to - from), length_m};
  thread_local std::vector<double> cuts_m, more_m;
  cuts_m.clear();
  for (const Outline& each : obstacles_)
    if (!apart(each, from, to) && !cut(each, way, cuts_m)) return std::nullopt;
  if (!cut(border_, way, cuts_m)) return std::nullopt;
  if (!open_beside(way, cuts_m, [this](Point at) { return is_free(at); })) return std::nullopt;
  Label places = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (apart(places_[k], from, to)) continue;
    more_m.clear();
    const bool crossed = !cut(places_[k], way, more_m);
    if (!crossed && more_m.empty()) continue;
    more_m.insert(more_m.end(), cuts_m.begin(), cuts_m.end());
    const auto outside = [&](Point at) { return !inside(places_[k].ring, at) && is_free(at); };
    if (crossed || !open_beside(way, more_m, outside)) places |= Label{1} << k;
  }
  return places;
}

}  // namespace stepwright::ltl
