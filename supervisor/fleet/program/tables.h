#pragma once

// Paths and polygons as ST initial values. Pure.
//
// The names of tables end with a digest of what they hold: an online change carries variables by name, and a
// table with other content must not keep the old one.

#include <string>

#include "ladder/graphic/project.h"
#include "supervisor/fleet/program/interlocks.h"
#include "supervisor/fleet/program/path_table.h"

namespace stepwright::fleet {

struct VehicleTables {
  graphic::Variable path;    // ARRAY OF MC_PATH_POINT; without a name where the path goes nowhere
  graphic::Variable areas;   // ARRAY OF MC_AREA
  graphic::Variable planes;  // ARRAY OF MC_HALF_PLANE
  std::size_t samples = 0;
  std::size_t polygons = 0;
  std::size_t sides = 0;
  std::size_t bytes = 0;
};

// Fails with F1104.
[[nodiscard]] result::Result<VehicleTables> vehicle_tables(const VehicleMission& mission,
                                                           const std::string& name,
                                                           const std::vector<double>& free_m,
                                                           const ProgramOptions& options);

}  // namespace stepwright::fleet
