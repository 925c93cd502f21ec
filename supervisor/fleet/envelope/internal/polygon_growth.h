#pragma once

// Polygons around stretches of one path, free of obstacles: what grow_envelope and grow_between_stands are
// made of. Borrows map, path and options. Any number of threads may ask one object.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/fleet/envelope/grow_envelope.h"
#include "supervisor/fleet/envelope/internal/side_polygon.h"

namespace stepwright::fleet::internal {

class PolygonGrowth {
 public:
  PolygonGrowth(const OccupancyGrid& map, const geometry::Footprint& footprint,
                std::span<const geometry::PathPose> path, const EnvelopeOptions& options);

  // A polygon that holds the vehicle at `pose` and at the next one at least, and as much of the way from
  // there as fits; nothing if an obstacle is between.
  std::optional<geometry::ConvexPolygon> from(std::size_t pose) const;
  // A small one around these two poses, which are one or neighbours, along the heading at `stand`.
  std::optional<geometry::ConvexPolygon> around(std::size_t stand, std::size_t neighbour) const;

  // The run of poses around `pose` at which the polygon holds the vehicle, from `earliest` to `latest`.
  Visit visit(const geometry::ConvexPolygon& polygon, std::size_t pose, std::size_t earliest,
              std::size_t latest) const;

 private:
  struct Start {
    SidePolygon sides;
    std::size_t last = 0;  // the last pose that was laid in
  };

  std::size_t after(std::size_t pose) const;
  double direction(std::size_t pose) const;
  bool reaches_far(std::size_t pose, std::size_t last) const;
  bool free(const geometry::ConvexPolygon& polygon) const;
  std::optional<Start> lay(int sides, std::size_t pose) const;
  geometry::ConvexPolygon grow(SidePolygon sides, double growth_m) const;
  bool move_all(SidePolygon& sides, const std::vector<bool>& stuck, double by_m) const;
  std::optional<geometry::ConvexPolygon> hull_of_two(std::size_t one, std::size_t other) const;

  const OccupancyGrid& map_;
  std::span<const geometry::PathPose> path_;
  const EnvelopeOptions& options_;
  std::vector<geometry::ConvexPolygon> outlines_;
};

}  // namespace stepwright::fleet::internal
