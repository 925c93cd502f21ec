#pragma once

// Inverse kinematics by damped Newton steps from many starts: for arms of any kind.
//
//   const auto found = solve_by_newton(*chain, tip, {.seed = 1, .most = 8});
//
// A function without state; any thread. The same seed gives the same solutions on every machine that has the
// same sine and cosine. That none is found proves nothing. Steps are damped by the error itself (Levenberg
// and Marquardt; Sugihara 2011, Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method)
// and cut at the limits.

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/motion/kinematics/chain.h"

namespace stepwright::motion {

struct NewtonOptions {
  std::uint64_t seed = 1;
  std::size_t starts = 64;    // random ones within the limits, after `near`
  std::size_t steps = 60;     // of each start
  std::size_t most = 1;       // solutions after which the search ends
  double position_m = 1e-10;  // that a solution may be off
  double angle_rad = 1e-10;
  double apart_rad = 1e-3;            // solutions nearer to each other, in every joint, count once
  std::span<const double> near = {};  // the first start, size() values; empty: none
};

// In the order in which they are found; each within the limits. Joints without limits start within half a
// turn.
std::vector<std::vector<double>> solve_by_newton(const Chain& chain, const Transform& tip,
                                                 const NewtonOptions& options);

}  // namespace stepwright::motion
