#pragma once

// A vehicle's path as the samples that MC_DrivePath takes: places of rest twice, speeds that curves, the
// steering and braking allow, and how far the polygons let the vehicle go to either side. Pure functions.
//
//   const std::vector<PathSample> samples = path_table(mission, options);

#include <vector>

#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/vehicle/path_samples.h"

namespace stepwright::fleet {

using vehicle::PathSample;

// Empty where the path goes nowhere.
std::vector<PathSample> path_table(const VehicleMission& mission, const ProgramOptions& options);

}  // namespace stepwright::fleet
