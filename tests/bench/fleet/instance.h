#pragma once

// Scheduling problems of the benchmark, from seeds alone.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "supervisor/fleet/schedule/problem.h"
#include "supervisor/geometry/point.h"

namespace stepwright::bench::fleet {

struct Instance {
  std::vector<stepwright::fleet::TrajectoryEnvelope> envelopes;
  std::vector<stepwright::fleet::TemporalConstraint> constraints;

  std::size_t polygons() const;
};

// How a vehicle gets from one pose to another: the seam at which other paths come in.
using Route =
    std::function<std::vector<geometry::Pose>(const geometry::Pose& from, const geometry::Pose& to)>;

struct Vehicle {
  double length_m = 4.0;
  double width_m = 1.4;
  double growth_m = 1.5;  // how far polygons reach beyond the vehicle
  double v_min_mps = 0.05;
  double v_max_mps = 1.5;
  bool goal_polygon =
      false;  // a last polygon around the goal alone, so that a parked vehicle takes little room
};

// A smooth curve, a cubic of Hermite, sampled about every 0.2 m. It may turn more sharply than a vehicle can.
std::vector<geometry::Pose> curve(const geometry::Pose& from, const geometry::Pose& to);

// The polygons along a path, as in the paper: a box along the path at a point, the next one at the first
// point outside of it; times from the lengths of path within polygons and overlaps.
stepwright::fleet::TrajectoryEnvelope envelope_along(const std::string& name,
                                                     std::span<const geometry::Pose> path,
                                                     const Vehicle& vehicle);

// 2 to 10 vehicles between ten points of a circle of 40 m, all from time zero on (the paper's 900 problems).
// Starts differ, goals differ, no vehicle stays; the seed of the generator is 10000 * vehicles + run.
Instance circle(std::uint32_t vehicles, std::uint32_t run, const Vehicle& vehicle, const Route& route);

// Aisles of 10 m that cross each other, square by square; in each stretch of seven aisles one vehicle follows
// another one over five crossings, from and to the middle between two. There always is a schedule, one
// vehicle after the other, although all block each other where they may meet at a crossing.
Instance warehouse(std::uint32_t vehicles, std::uint32_t run, const Vehicle& vehicle);

}  // namespace stepwright::bench::fleet
