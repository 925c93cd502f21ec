#include "supervisor/motion/spheres/body_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stepwright::motion {

namespace {

double coordinate(const Vector3& point, std::size_t axis) {
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

// Where the edge meets the plane: exactly on it along the axis.
Vector3 crossing(const Vector3& a, const Vector3& b, std::size_t axis, double at) {
  const double from = coordinate(a, axis), to = coordinate(b, axis);
  const double share = (at - from) / (to - from);
  Vector3 point = a + share * (b - a);
  (axis == 0 ? point.x : axis == 1 ? point.y : point.z) = at;
  return point;
}

// The part of a convex polygon on one side, border included (Sutherland and Hodgman 1974).
void add_side(std::span<const Vector3> polygon, std::size_t axis, double at, bool above, BodyPiece& to) {
  const auto keeps = [&](const Vector3& p) {
    return above ? coordinate(p, axis) >= at : coordinate(p, axis) <= at;
  };
  const std::size_t first = to.corners.size();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3 &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
    if (keeps(here)) to.corners.push_back(here);
    const double from = coordinate(here, axis), until = coordinate(next, axis);
    if ((from < at && until > at) || (from > at && until < at))
      to.corners.push_back(crossing(here, next, axis, at));
  }
  if (to.corners.size() > first) to.polygon_ends.push_back(static_cast<std::uint32_t>(to.corners.size()));
}

}  // namespace

bool BodyPiece::empty() const {
  return corners.empty() && std::none_of(inside.begin(), inside.end(), [](bool each) { return each; });
}

Vector3 BodyPiece::cell_corner(unsigned k) const {
  return {k & 1U ? high[0] : low[0], k & 2U ? high[1] : low[1], k & 4U ? high[2] : low[2]};
}

std::vector<Vector3> BodyPiece::points() const {
  std::vector<Vector3> all = corners;
  for (unsigned k = 0; k < 8; ++k)
    if (inside[k]) all.push_back(cell_corner(k));
  return all;
}

bool BodyPieces::is_inside(Vector3 point) const {
  // Low, so that meshes with holes count as bodies; a corner that is taken in needlessly does no harm.
  constexpr double kInside = 0.3;
  return std::abs(winding_number(mesh_, point)) > kInside;
}

BodyPiece BodyPieces::whole() const {
  BodyPiece piece;
  piece.low.fill(std::numeric_limits<double>::infinity());
  piece.high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const Vector3& corner : mesh_.corners(t)) {
      piece.corners.push_back(corner);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        piece.low[axis] = std::min(piece.low[axis], coordinate(corner, axis));
        piece.high[axis] = std::max(piece.high[axis], coordinate(corner, axis));
      }
    }
    piece.polygon_ends.push_back(static_cast<std::uint32_t>(piece.corners.size()));
  }
  return piece;  // no corner of the box around a body is inside of it
}

std::pair<BodyPiece, BodyPiece> BodyPieces::cut(const BodyPiece& piece, std::size_t axis, double at_m) const {
  std::pair<BodyPiece, BodyPiece> sides;
  auto& [below, above] = sides;
  below.low = above.low = piece.low;
  below.high = above.high = piece.high;
  below.high[axis] = above.low[axis] = at_m;
  std::size_t begin = 0;
  for (const std::uint32_t end : piece.polygon_ends) {
    const std::span polygon(piece.corners.data() + begin, end - begin);
    add_side(polygon, axis, at_m, false, below);
    add_side(polygon, axis, at_m, true, above);
    begin = end;
  }
  const unsigned bit = 1U << axis;
  for (unsigned k = 0; k < 8; ++k) {
    if (k & bit) {
      above.inside[k] = piece.inside[k];
      below.inside[k] = is_inside(below.cell_corner(k));
      above.inside[k ^ bit] = below.inside[k];
    } else {
      below.inside[k] = piece.inside[k];
    }
  }
  return sides;
}

}  // namespace stepwright::motion
