#pragma once

// A convex region by a fixed number of sides of given directions, which move outwards one by one: the box
// that Pecora and Cirillo grow, and its relatives with eight and sixteen sides. A value.

#include <optional>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::fleet::internal {

class SidePolygon {
 public:
  // `sides` is 4, 8 or 16; the first one faces `direction_rad`. Holds nothing yet.
  SidePolygon(int sides, double direction_rad);

  // Moves the sides out until the points are inside.
  void include(const geometry::ConvexPolygon& region);
  void move_side(std::size_t side, double by_m) { offsets_[side] += by_m; }
  std::size_t sides() const { return offsets_.size(); }
  // Requires a region that was included.
  geometry::ConvexPolygon polygon() const;

 private:
  std::vector<geometry::Point> normals_;
  std::vector<double> offsets_;  // normal * point <= offset
};

}  // namespace stepwright::fleet::internal
