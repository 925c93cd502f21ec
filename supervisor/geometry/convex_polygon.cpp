#include "supervisor/geometry/convex_polygon.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace stepwright::geometry {

namespace {

// Corners nearer to a line than this lie on it; regions that reach less far into each other only touch.
constexpr double kTouching_m = 1e-9;

double distance_left_of(Point from, Point to, Point point) {
  const double length = distance(from, to);
  return length == 0.0 ? 0.0 : cross(to - from, point - from) / length;
}

// One half of the hull: the points in order, without those that a later one cuts off (Andrew 1979).
void extend_chain(std::vector<Point>& chain, std::size_t first, Point point) {
  while (chain.size() >= first + 2 &&
         distance_left_of(chain[chain.size() - 2], point, chain.back()) >= -kTouching_m) {
    chain.pop_back();
  }
  chain.push_back(point);
}

// Whether all of `other` lies beyond one side of `polygon`.
bool separates(std::span<const Point> polygon, std::span<const Point> other) {
  auto inside = other.begin();  // of the side before: mostly of the next one, too
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point from = polygon[k];
    const Point to = polygon[(k + 1) % polygon.size()];
    const Point along = to - from;
    const double touching = kTouching_m * kTouching_m * dot(along, along);
    const auto outside = [&](Point p) {
      const double left = cross(along, p - from);
      return left <= 0.0 || left * left <= touching;
    };
    if (!outside(*inside)) continue;
    inside = std::ranges::find_if_not(other, outside);
    if (inside == other.end()) return true;
  }
  return false;
}

bool apart(const Box& a, const Box& b) {
  return a.high.x_m <= b.low.x_m || b.high.x_m <= a.low.x_m || a.high.y_m <= b.low.y_m ||
         b.high.y_m <= a.low.y_m;
}

// Sutherland and Hodgman 1974: what of `corners` lies to the left of the line.
std::vector<Point> clip(std::span<const Point> corners, Point from, Point to) {
  std::vector<Point> kept;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point here = corners[k];
    const Point next = corners[(k + 1) % corners.size()];
    const double left_here = cross(to - from, here - from);
    const double left_next = cross(to - from, next - from);
    if (left_here >= 0.0) kept.push_back(here);
    if ((left_here > 0.0 && left_next < 0.0) || (left_here < 0.0 && left_next > 0.0)) {
      kept.push_back(here + (left_here / (left_here - left_next)) * (next - here));
    }
  }
  return kept;
}

}  // namespace

ConvexPolygon::ConvexPolygon(std::vector<Point> corners)
    : corners_(std::move(corners)), bounds_(bounds_of(corners_)) {}

std::optional<ConvexPolygon> ConvexPolygon::hull(std::span<const Point> points) {
  const auto finite = [](Point p) { return std::isfinite(p.x_m) && std::isfinite(p.y_m); };
  if (points.size() < 3 || !std::ranges::all_of(points, finite)) return std::nullopt;
  std::vector<Point> sorted(points.begin(), points.end());
  std::ranges::sort(sorted, [](Point a, Point b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.y_m < b.y_m; });
  std::vector<Point> chain;
  for (const Point p : sorted) extend_chain(chain, 0, p);
  const std::size_t upper = chain.size() - 1;
  for (auto p = sorted.rbegin() + 1; p != sorted.rend(); ++p) extend_chain(chain, upper, *p);
  chain.pop_back();
  if (chain.size() < 3) return std::nullopt;
  return ConvexPolygon(std::move(chain));
}

double ConvexPolygon::area_m2() const {
  double twice = 0.0;
  for (std::size_t k = 2; k < corners_.size(); ++k) {
    twice += cross(corners_[k - 1] - corners_[0], corners_[k] - corners_[0]);
  }
  return 0.5 * twice;
}

Point ConvexPolygon::centroid() const {
  Point weighted;
  double twice_area = 0.0;
  for (std::size_t k = 2; k < corners_.size(); ++k) {
    const double twice = cross(corners_[k - 1] - corners_[0], corners_[k] - corners_[0]);
    weighted = weighted + twice * ((corners_[k - 1] - corners_[0]) + (corners_[k] - corners_[0]));
    twice_area += twice;
  }
  return corners_[0] + (1.0 / (3.0 * twice_area)) * weighted;
}

std::vector<HalfPlane> ConvexPolygon::half_planes() const {
  std::vector<HalfPlane> sides;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Point along = corners_[(k + 1) % corners_.size()] - corners_[k];
    const Point normal = (1.0 / std::hypot(along.x_m, along.y_m)) * Point{along.y_m, -along.x_m};
    sides.push_back({normal, dot(normal, corners_[k])});
  }
  return sides;
}

bool ConvexPolygon::contains(Point point, double slack_m) const {
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Point along = corners_[(k + 1) % corners_.size()] - corners_[k];
    const double left = cross(along, point - corners_[k]);
    if (left < 0.0 && left * left > slack_m * slack_m * dot(along, along)) return false;
  }
  return true;
}

bool ConvexPolygon::contains(const ConvexPolygon& inner, double slack_m) const {
  return std::ranges::all_of(inner.corners(), [&](Point p) { return contains(p, slack_m); });
}

bool overlaps(const ConvexPolygon& a, const ConvexPolygon& b) {
  return !apart(a.bounds(), b.bounds()) && !separates(a.corners(), b.corners()) &&
         !separates(b.corners(), a.corners());
}

std::optional<ConvexPolygon> intersection(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (!overlaps(a, b)) return std::nullopt;
  std::vector<Point> corners(a.corners().begin(), a.corners().end());
  const auto sides = b.corners();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    corners = clip(corners, sides[k], sides[(k + 1) % sides.size()]);
  }
  return ConvexPolygon::hull(corners);
}

ConvexPolygon footprint_at(const Pose& pose, const Footprint& footprint) {
  std::array<Point, 4> corners = {
      from_frame(pose, {-footprint.rear_m, -footprint.half_width_m}),
      from_frame(pose, {footprint.front_m, -footprint.half_width_m}),
      from_frame(pose, {footprint.front_m, footprint.half_width_m}),
      from_frame(pose, {-footprint.rear_m, footprint.half_width_m}),
  };
  // Anticlockwise as they are; like those of a hull they begin with the one farthest to the left.
  const auto first = std::ranges::min_element(
      corners, [](Point a, Point b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.y_m < b.y_m; });
  std::ranges::rotate(corners, first);
  return ConvexPolygon({corners.begin(), corners.end()});
}

}  // namespace stepwright::geometry
