#pragma once

// A vehicle's path as the samples that MC_MovePath takes: places of rest twice, speeds that curves, the
// steering and braking allow, and how far the polygons let the vehicle go to either side. Pure functions.
//
//   const std::vector<PathSample> samples = path_table(mission, options);

#include <vector>

#include "supervisor/fleet/program/fleet_program.h"

namespace stepwright::fleet {

struct PathSample {
  geometry::Pose pose;         // heading without leaps
  double curvature_1_m = 0.0;  // of the steering from here to the next sample
  double arc_m = 0.0;
  double speed_m_s = 0.0;
  double rest_m = 0.0;  // arc of the next place of rest
  double left_m = 0.0;
  double right_m = 0.0;
  double way = 1.0;  // -1 in reverse
};

// Empty where the path goes nowhere.
std::vector<PathSample> path_table(const VehicleMission& mission, const ProgramOptions& options);

}  // namespace stepwright::fleet
