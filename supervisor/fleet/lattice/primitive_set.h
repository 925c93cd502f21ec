#pragma once

// The motion primitives of a vehicle, sixteen for each heading: eight forward, eight in reverse.
//
// A value that does not change; any thread may read. For each heading: a short and a long straight line,
// turns to the next two headings on either side, and a shift to the next parallel line of vertices on either
// side. Turns are straight line, arc, straight line; shifts are two arcs. All are solved in closed form, end
// exactly on a vertex, and are the shortest of their kind that the turning radius allows. A reverse primitive
// is a forward one driven backwards. The set looks the same from each of the four directions of the grid, and
// in the mirrors along its axes and diagonals. supervisor/doc/fleet_paths.md derives the equations.
//
//   const PrimitiveSet primitives(vehicle, {});
//   for (const MotionPrimitive& primitive : primitives.from(heading)) ...

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/lattice/motion_primitive.h"
#include "supervisor/fleet/lattice/vehicle_model.h"

namespace stepwright::fleet {

struct LatticeOptions {
  double resolution_m = 0.2;    // between vertices
  double reverse_factor = 2.0;  // cost of a metre in reverse, at least 1
  double turn_factor = 1.2;     // cost of a metre of a primitive that is not straight, at least 1
  double long_straight_m = 1.0;
};

using Digest = std::array<std::uint8_t, 32>;

class PrimitiveSet {
 public:
  static constexpr int kPerHeading = 16;

  // Requires a vehicle that `check` accepts.
  PrimitiveSet(const VehicleModel& vehicle, const LatticeOptions& options);

  const LatticeOptions& options() const { return options_; }
  std::span<const MotionPrimitive> all() const { return primitives_; }
  // The k-th of a heading is the k-th of the heading a right angle further, turned by it.
  std::span<const MotionPrimitive> from(int heading) const {
    return std::span(primitives_).subspan(static_cast<std::size_t>(heading) * kPerHeading, kPerHeading);
  }
  // SHA-256 over resolution, ends, headings and costs: all on which a table of costs depends.
  Digest digest() const;

 private:
  LatticeOptions options_;
  std::vector<MotionPrimitive> primitives_;  // by heading of their start
};

}  // namespace stepwright::fleet
