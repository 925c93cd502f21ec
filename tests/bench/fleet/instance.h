#pragma once

// Scheduling problems of the benchmark, from seeds alone.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "supervisor/fleet/schedule/problem.h"
#include "supervisor/geometry/point.h"
#include "tests/bench/lattice/circle_envelopes.h"

namespace stepwright::bench::fleet {

struct Instance {
  std::vector<stepwright::fleet::TrajectoryEnvelope> envelopes;
  std::vector<stepwright::fleet::TemporalConstraint> constraints;

  std::size_t polygons() const;
};

struct Vehicle {
  double length_m = 4.0;
  double width_m = 1.4;
  double growth_m = 1.5;  // how far polygons reach beyond the vehicle
  double v_min_mps = 0.05;
  double v_max_mps = 1.5;
  bool goal_polygon =
      false;  // a last polygon around the goal alone, so that a parked vehicle takes little room
};

// The polygons along a path, as in the paper: a box along the path at a point, the next one at the first
// point outside of it; times from the lengths of path within polygons and overlaps.
stepwright::fleet::TrajectoryEnvelope envelope_along(const std::string& name,
                                                     std::span<const geometry::Pose> path,
                                                     const Vehicle& vehicle);

// The paper's 900 problems (support/fleet/circle_problem.h): 2 to 10 vehicles on a circle of 40 m, all from
// time zero on, on paths of the lattice, with polygons grown along them. Each way is planned when it is first
// asked for.
class CircleSource {
 public:
  CircleSource();
  Instance instance(std::uint32_t vehicles, std::uint32_t run, double v_max_mps);

 private:
  stepwright::fleet::VehicleModel vehicle_;
  stepwright::fleet::PrimitiveSet primitives_{vehicle_, {}};
  stepwright::fleet::HeuristicTable table_ =
      stepwright::fleet::HeuristicTable::build(primitives_, {.range_m = 41.0, .threads = 2});
  CircleEnvelopes circle_;
};

// Aisles of 10 m that cross each other, square by square; in each stretch of seven aisles one vehicle follows
// another one over five crossings, from and to the middle between two. There always is a schedule, one
// vehicle after the other, although all block each other where they may meet at a crossing.
Instance warehouse(std::uint32_t vehicles, std::uint32_t run, const Vehicle& vehicle);

}  // namespace stepwright::bench::fleet
