#pragma once

// Distances from each vertex of the lattice to the goal around obstacles, whatever the heading: the estimate
// that finds the way through tunnels (Pecora and Cirillo 2012, "Trajectory Planning").
//
// A value that does not change; any thread may read. The paper's graph has eight neighbours, whose distances
// are up to 8 percent longer than straight lines: no lower bound. Here the steps are the vectors of the
// sixteen headings, and `lower_bound_mm` never exceeds the cost of the rest of a way on the lattice, and is
// consistent: along each primitive there is a chain of such steps, each vertex within kDetour of the track,
// whose length is at most `detour` times the primitive's cost; and where the vehicle fits, none of these
// vertices is nearer to an obstacle than its inscribed radius less kDetour (supervisor/doc/fleet_paths.md).
//
//   const ObstacleDistances distances(clearance, {.goal = {80, 40}, .start = {5, 5}, ...});

#include <atomic>
#include <cstdint>
#include <vector>

#include "supervisor/fleet/lattice/primitive_set.h"
#include "supervisor/map/distance_field.h"

namespace stepwright::fleet {

// How far a vertex of the chain may lie from the track, as a share of the resolution: the nearest corner of a
// square is within 0.71 of each of its points, so that the chain never breaks.
inline constexpr double kDetour = 0.75;

// The largest quotient of a primitive's cheapest chain and its cost, as a share of 65536, rounded up.
std::uint32_t detour_of(const PrimitiveSet& primitives);
// The same with lengths instead of costs: distances less this detour never exceed the length of any way on
// the lattice, whatever it costs. What turns costs more than it is long, so that this is the larger one.
std::uint32_t length_detour_of(const PrimitiveSet& primitives);

struct ObstacleQuestion {
  GridVector goal;  // vertices, both within the lattice
  GridVector start;
  std::int32_t columns = 0;  // of vertices
  std::int32_t rows = 0;
  int cells_per_step = 1;
  double resolution_m = 0.2;
  double inscribed_radius_m = 0.7;
  std::uint32_t detour = 65536;
  const std::atomic<bool>* cancel = nullptr;  // looked at now and then; not owned, may be null
};

class ObstacleDistances {
 public:
  ObstacleDistances(const DistanceField& clearance, const ObstacleQuestion& question);

  // Whether even a disc of the inscribed radius, less kDetour, finds no way from the start.
  bool unreachable() const { return unreachable_; }
  // It was cancelled: all bounds are 0, and nothing is known of what can be reached.
  bool cancelled() const { return cancelled_; }
  std::uint32_t lower_bound_mm(GridVector vertex) const { return bounds_[index(vertex)]; }

 private:
  std::size_t index(GridVector vertex) const {
    return static_cast<std::size_t>(vertex.y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(vertex.x);
  }
  void finish(std::uint32_t last, std::uint32_t detour);

  std::int32_t columns_ = 0;
  bool unreachable_ = false;
  bool cancelled_ = false;
  // Vertices that were not looked at hold the distance at which looking ended: a lower bound of theirs.
  std::vector<std::uint32_t> bounds_;
};

}  // namespace stepwright::fleet
