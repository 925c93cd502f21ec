#pragma once

// Clearances: the polygons that vehicles may enter, from the precedences of a plan and what vehicles have
// reached.
//
// A polygon is clear once the first vehicle of each precedence on it, and on the polygons before it, has left
// its own. A vehicle has left polygon k once it is whole within k + 1 and k + 1 is clear: one that waits in
// the overlap of both counts as still in k, since k + 1 is not its own yet. Both only grow.
//
// One thread at a time. Indices are of the plan that it was made for.
//
//   Clearances clearances(plan);
//   for (const std::uint32_t other : clearances.reached(3, 5)) extend_base(other, clearances.clear(other));

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet::vda5050 {

class Clearances {
 public:
  // Precedences name vehicles and polygons of the plan.
  explicit Clearances(const FleetPlan& plan);

  // The vehicle is whole within this polygon now. Returns whose clear() has grown, each once.
  std::vector<std::uint32_t> reached(std::uint32_t vehicle, std::uint32_t polygon);

  // How many polygons, from the first one, the vehicle may enter.
  std::uint32_t clear(std::uint32_t vehicle) const { return vehicles_[vehicle].clear; }
  // How many polygons, from the first one, it has left.
  std::uint32_t left(std::uint32_t vehicle) const { return vehicles_[vehicle].left; }

 private:
  struct Polygon {
    std::uint32_t awaited = 0;          // precedences that are not met yet
    std::vector<PolygonRef> followers;  // who waits until this one is left
  };
  struct Vehicle {
    std::vector<Polygon> polygons;
    std::uint32_t reached = 0;
    std::uint32_t clear = 0;
    std::uint32_t left = 0;
  };
  bool advance_clear(Vehicle& vehicle) const;

  std::vector<Vehicle> vehicles_;
};

}  // namespace stepwright::fleet::vda5050
