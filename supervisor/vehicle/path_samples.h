#pragma once

// A path as the samples that MC_DrivePath takes (ladder/driver/library/vehicle_path.st): places of rest
// twice, speeds that curves, the steering and braking allow. Pure functions; any thread.
//
//   std::vector<PathLeg> legs = {{{{0, 0, 0}, 0.0}, {{1, 0, 0}, 1.0}}};
//   std::vector<PathSample> samples = path_samples(legs, {.wheelbase_m = 1.0});

#include <vector>

#include "supervisor/geometry/path.h"
#include "supervisor/vehicle/greatest_speeds.h"

namespace stepwright::vehicle {

struct PathSample {
  geometry::Pose pose;         // heading without leaps
  double curvature_1_m = 0.0;  // of the steering from here to the next sample
  double arc_m = 0.0;
  double speed_m_s = 0.0;
  double rest_m = 0.0;   // arc of the next place of rest
  double left_m = 10.0;  // how far the vehicle may be off the path, to the left and to the right
  double right_m = 10.0;
  double way = 1.0;  // -1 in reverse
};

// From one place of rest to the next: at least two poses of growing arcs, which count along the whole path.
// The last one tells the direction of all.
using PathLeg = std::vector<geometry::PathPose>;

struct SampleLimits {
  double wheelbase_m = 1.0;
  SpeedLimits speed;
};

// One for each pose. Whoever has less room than ten metres beside the path says so afterwards.
std::vector<PathSample> path_samples(const std::vector<PathLeg>& legs, const SampleLimits& limits);

}  // namespace stepwright::vehicle
