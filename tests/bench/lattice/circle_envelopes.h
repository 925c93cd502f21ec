#pragma once

// Paths and envelopes of the 900 circle problems. Each of the 5760 ways between two of the 80 poses on
// different points is planned and grown once, when it is first asked for. Not for several threads.
//
//   CircleEnvelopes circle(primitives, table, {});
//   const auto& grown = circle.of(task);

#include <cstdint>
#include <map>
#include <utility>

#include "supervisor/fleet/envelope/grow_envelope.h"
#include "supervisor/fleet/lattice/path_planner.h"
#include "tests/support/fleet/circle_problem.h"

namespace stepwright::bench {

class CircleEnvelopes {
 public:
  // A table that reaches across the floor makes A* quick here; it changes no cost.
  CircleEnvelopes(const fleet::VehicleModel& vehicle, const fleet::PrimitiveSet& primitives,
                  const fleet::HeuristicTable& table, const fleet::EnvelopeOptions& options);

  const fleet::GrownEnvelope& of(const support::CircleTask& task);
  std::uint64_t expanded() const { return expanded_; }
  std::size_t planned() const { return known_.size(); }
  double length_m() const { return length_m_; }
  double path_ms() const { return path_ms_; }
  double growth_ms() const { return growth_ms_; }

 private:
  fleet::VehicleModel vehicle_;
  fleet::OccupancyGrid floor_;
  fleet::PathPlanner planner_;
  fleet::EnvelopeOptions options_;
  std::map<std::pair<int, int>, fleet::GrownEnvelope> known_;
  std::uint64_t expanded_ = 0;
  double length_m_ = 0.0;
  double path_ms_ = 0.0;
  double growth_ms_ = 0.0;
};

}  // namespace stepwright::bench
