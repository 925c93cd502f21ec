#pragma once

// Small scheduling problems at random: few vehicles that wander through a small place, so that they meet head
// on, cross and follow each other.

#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "supervisor/fleet/schedule/problem.h"

namespace stepwright::fleet {

struct Problem {
  std::vector<TrajectoryEnvelope> envelopes;
  std::vector<TemporalConstraint> constraints;
};

// A rectangle in metres.
geometry::ConvexPolygon rectangle(double x0_m, double y0_m, double x1_m, double y1_m);
// A vehicle named `name` through unit squares of a lane from column to column, 1 s in each, 200 ms in
// overlaps.
TrajectoryEnvelope lane(const std::string& name, int from, int to, double y_m,
                        std::chrono::milliseconds most);

// `size` bounds the polygons of a vehicle.
Problem random_problem(std::uint32_t vehicles, std::uint32_t size, std::mt19937& random);

}  // namespace stepwright::fleet
