#pragma once

// Swept cells: those that a vehicle covers while it drives a motion primitive, worked out once, so that a
// collision check is a look at runs of bits (Pecora and Cirillo 2012, "Trajectory Planning").
//
// A value that does not change; any thread may read. Conservative: a cell that the outline touches anywhere
// along the motion is in the set; so is one that it passes within `clearance_m`. Others may be in the set
// only if the outline passes within that and 15 mm.
//
//   const SweptCells cells(vehicle, primitives, 1);
//   if (cells.free(map, clearance, {12, 40}, primitive_index)) ...

#include <array>
#include <cstdint>
#include <vector>

#include "supervisor/fleet/lattice/primitive_set.h"
#include "supervisor/map/distance_field.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet {

// A disc around a corner of the grid.
struct CoverDisc {
  Cell middle;
  float radius_m = 0.0F;
};

struct SweptMotion {
  std::vector<RowSpan>
      spans;  // relative to the cell at the upper right of the vertex where the motion begins
  std::array<CoverDisc, 6> discs{};  // together they cover all cells of the set
  float reach_m = 0.0F;              // no covered point is farther from that vertex
};

class SweptCells {
 public:
  // The cells are `cells_per_step` times smaller than the distance between vertices, and have a corner at
  // each.
  SweptCells(const VehicleModel& vehicle, const PrimitiveSet& primitives, int cells_per_step);

  // As much as a convex region needs that holds the outline at two poses kPathSample_m apart, at the tightest
  // turn, and 5 mm: an envelope can always grow around a path (supervisor/doc/fleet_paths.md).
  static double clearance_m(const VehicleModel& vehicle);

  int cells_per_step() const { return cells_per_step_; }
  const SweptMotion& of_primitive(std::size_t index) const { return motions_[index]; }
  // The vehicle standing with this heading.
  const SweptMotion& of_heading(int heading) const { return stands_[static_cast<std::size_t>(heading)]; }

  // Whether the motion from the corner of `cell` meets no obstacle and stays on the map.
  static bool free(const OccupancyGrid& grid, const DistanceField& clearance, const SweptMotion& motion,
                   Cell cell) {
    return clearance.at_corner(cell) > motion.reach_m || discs_free(grid, clearance, motion, cell) ||
           cells_free(grid, motion, cell);
  }

 private:
  static bool discs_free(const OccupancyGrid& grid, const DistanceField& clearance, const SweptMotion& motion,
                         Cell cell);
  static bool cells_free(const OccupancyGrid& grid, const SweptMotion& motion, Cell cell);

  int cells_per_step_ = 1;
  std::vector<SweptMotion> motions_;  // one for each primitive
  std::vector<SweptMotion> stands_;   // one for each heading
};

}  // namespace stepwright::fleet
