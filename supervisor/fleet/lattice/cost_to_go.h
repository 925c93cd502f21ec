#pragma once

// Least costs from every pose of a floor to one goal: exact on this floor, and a lower bound on every floor
// that has more obstacles. The estimate for goals to which many ways are asked for.
//
// A value that does not change; any thread may read. Worked out by Dijkstra's algorithm backwards from the
// goal over all of the lattice: a fraction of a second for a hall of 100 m, after which a search from
// anywhere hardly leaves its way. The motions must outlive it.
//
//   const CostToGo to_dock(motions, primitives, {{12, 40}, 4});
//   to_dock.lower_bound_mm({200, 30}, 0);

#include <cstdint>
#include <vector>

#include "supervisor/fleet/lattice/free_motions.h"

namespace stepwright::fleet {

class CostToGo {
 public:
  static constexpr std::uint32_t kNoWay = 0xFFFFFFFF;

  CostToGo(const FreeMotions& motions, const PrimitiveSet& primitives, GridVector goal, int heading);

  // kNoWay: there is none, or the vehicle cannot stand there. Rounded down; ways of more than half a
  // kilometre are only known to be so long.
  std::uint32_t lower_bound_mm(GridVector vertex, int heading) const {
    const auto pose = motions_->number(vertex, heading);
    if (!pose || costs_[*pose] == kNever) return kNoWay;
    return std::uint32_t{costs_[*pose]} * kUnit_mm;
  }

 private:
  static constexpr std::uint32_t kUnit_mm = 8;
  static constexpr std::uint16_t kNever = 0xFFFF;

  const FreeMotions* motions_;
  std::vector<std::uint16_t> costs_;  // by pose, in units
};

}  // namespace stepwright::fleet
