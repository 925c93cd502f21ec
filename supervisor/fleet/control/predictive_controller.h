#pragma once

// A model predictive controller for a vehicle with one steered axle: over a horizon of 2 s, the accelerations
// and steering rates that keep it nearest to a reference and within convex areas. Iterated linear-quadratic
// regulator with bounded controls (Li and Todorov 2004; Tassa, Mansard, Todorov 2014, "Control-limited
// differential dynamic programming"); areas are penalties (Pecora and Cirillo 2012, "From Envelopes to
// Vehicle Control": polygons and times are the constraints).
//
// One thread at a time; keeps its last solution as the next start. No heap in solve().
//
//   PredictiveController controller(limits, footprint, {});
//   const Prediction made = controller.solve(state, reference);

#include <array>
#include <cstddef>
#include <span>

#include "supervisor/fleet/control/drive_limits.h"
#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::fleet {

inline constexpr std::size_t kHorizon = 20;
inline constexpr double kControlStep_s = 0.1;

// Where the vehicle should be at one instant of the horizon.
struct ReferenceState {
  VehicleState state;
  std::span<const geometry::HalfPlane> area{};  // the outline should stay within; empty = anywhere
};
using Reference = std::array<ReferenceState, kHorizon + 1>;

struct ControllerWeights {
  double across = 20.0;  // 1/m^2, beside the reference
  double along = 8.0;    // 1/m^2, ahead of or behind it
  double heading = 8.0;  // 1/rad^2
  double speed = 2.0;    // s^2/m^2
  double lock = 0.5;     // 1/rad^2
  double acceleration = 0.2;
  double lock_rate = 0.3;
  double area = 400.0;     // 1/m^2, beyond the border less the margin
  double margin_m = 0.05;  // to the border of an area
};

struct Prediction {
  std::array<VehicleState, kHorizon + 1> states;  // states[0] is the present
  double acceleration_m_s2 = 0.0;                 // of the first step
  double lock_rate_rad_s = 0.0;
  double cost = 0.0;
  int iterations = 0;
};

class PredictiveController {
 public:
  PredictiveController(const DriveLimits& limits, const geometry::Footprint& footprint,
                       const ControllerWeights& weights);

  const Prediction& solve(const VehicleState& now, const Reference& reference);
  // Forgets the last solution.
  void reset();

 private:
  struct Controls {
    double acceleration_m_s2 = 0.0;
    double lock_rate_rad_s = 0.0;
  };
  using Trajectory = std::array<VehicleState, kHorizon + 1>;
  using Sequence = std::array<Controls, kHorizon>;

  struct Gains;
  Controls bounded(const Controls& controls) const;
  VehicleState after(const VehicleState& state, const Controls& controls) const;
  double cost_of(const Trajectory& states, const Sequence& controls, const Reference& reference) const;
  void sweep_back(const Reference& reference, std::array<Gains, kHorizon>& gains) const;
  double sweep_on(const std::array<Gains, kHorizon>& gains, double part, const Reference& reference,
                  Trajectory& states, Sequence& controls) const;

  DriveLimits limits_;
  std::array<geometry::Point, 4> corners_;  // of the outline, in the frame of the reference point
  ControllerWeights weights_;
  Sequence controls_{};
  Prediction made_;
};

}  // namespace stepwright::fleet
