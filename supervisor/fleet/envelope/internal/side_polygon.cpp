#include "supervisor/fleet/envelope/internal/side_polygon.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace stepwright::fleet::internal {

namespace {

using geometry::Point;

// Sutherland and Hodgman 1974: what of a region lies within one half-plane.
std::vector<Point> clipped(const std::vector<Point>& corners, Point normal, double offset) {
  std::vector<Point> kept;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point here = corners[k];
    const Point next = corners[(k + 1) % corners.size()];
    const double out_here = dot(normal, here) - offset;
    const double out_next = dot(normal, next) - offset;
    if (out_here <= 0.0) kept.push_back(here);
    if ((out_here < 0.0) != (out_next < 0.0) && out_here != 0.0 && out_next != 0.0) {
      kept.push_back(here + (out_here / (out_here - out_next)) * (next - here));
    }
  }
  return kept;
}

}  // namespace

SidePolygon::SidePolygon(int sides, double direction_rad)
    : offsets_(static_cast<std::size_t>(sides), -std::numeric_limits<double>::infinity()) {
  assert(sides == 4 || sides == 8 || sides == 16);
  for (int k = 0; k < sides; ++k) {
    const double angle = direction_rad + 2.0 * std::numbers::pi * k / sides;
    normals_.push_back({std::cos(angle), std::sin(angle)});
  }
}

void SidePolygon::include(const geometry::ConvexPolygon& region) {
  for (std::size_t k = 0; k < normals_.size(); ++k) {
    for (const Point corner : region.corners()) offsets_[k] = std::max(offsets_[k], dot(normals_[k], corner));
  }
}

geometry::ConvexPolygon SidePolygon::polygon() const {
  // The four sides at right angles make a box; the others cut its corners.
  const std::size_t quarter = normals_.size() / 4;
  std::vector<Point> corners;
  for (std::size_t k = 0; k < normals_.size(); k += quarter) {
    const std::size_t next = (k + quarter) % normals_.size();
    corners.push_back(offsets_[k] * normals_[k] + offsets_[next] * normals_[next]);
  }
  for (std::size_t k = 0; k < normals_.size(); ++k) {
    if (k % quarter != 0) corners = clipped(corners, normals_[k], offsets_[k]);
  }
  auto polygon = geometry::ConvexPolygon::hull(corners);
  assert(polygon.has_value());
  return *std::move(polygon);
}

}  // namespace stepwright::fleet::internal
