#pragma once

// Measured cost of the ground of motion planning: kinematics, and checks of collisions beside plain
// arithmetic and FCL on the same configurations.

#include <string>
#include <vector>

#include "tests/bench/motion/scene.h"

namespace stepwright::bench {

struct KinematicsFigures {
  double forward_ns = 0.0;  // seven joints, the tip
  double jacobian_ns = 0.0;
  double all_links_ns = 0.0;    // the whole robot
  double closed_form_ns = 0.0;  // all solutions of a swivel
  double arcs_us = 0.0;         // all arcs of a pose
  double newton_us = 0.0;       // one solution from random starts
  double newton_found_percent = 0.0;
  double worst_closed_form_m = 0.0;  // of all solutions: how far forward kinematics is off the pose
};
KinematicsFigures measure_kinematics(const MotionScene& scene);

struct CheckFigures {
  std::string name;
  double per_s = 0.0;  // configurations
  double colliding_percent = 0.0;
};
// Plain arithmetic, each instruction set of this machine, FCL with the same spheres and FCL with the bodies.
std::vector<CheckFigures> measure_checks(const MotionScene& scene);

struct TimingFigures {
  double blend_and_timing_ms = 0.0;  // a path of ten way-points, seven joints
  double rows = 0.0;                 // of its table, mean
  double straight_us = 0.0;          // double S of seven joints
  // Durations over what there is on grids four times as fine (plan_timing.h): minima, and bounds.
  double mean_ratio = 0.0, worst_ratio = 0.0;
  double mean_bound_ratio = 0.0, worst_bound_ratio = 0.0,
         within_one_percent = 0.0;        // the last: of the bounds
  std::size_t paths = 0, violations = 0;  // paths judged by samples; those with a limit exceeded by 1e-9
  double worst_share = 0.0;               // greatest use of a limit
};
TimingFigures measure_timing();

}  // namespace stepwright::bench
