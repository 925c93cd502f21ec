#pragma once

// From where a vehicle stands to a pose of the lattice, at which a new path can begin: along the path that it
// has driven, on or back. A new plan needs no other motion than that, and the vehicle is known to fit there.
//
// Pure functions.
//
//   // The first that is free is taken.
//   for (const LeadIn& way : lead_ins(mission.path, reading.arc_m, map.frame())) ...

#include <vector>

#include "supervisor/geometry/convex_polygon.h"
#include "supervisor/geometry/path.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

struct LeadIn {
  geometry::Path path;   // from the vehicle to `start`; one pose if it stands there
  geometry::Pose start;  // of the lattice
};

// Whether paths can be planned from there exactly.
bool on_lattice(const geometry::Pose& pose, const GridFrame& frame);

// None, one or both: on to the next such pose, back to the last one. Where the vehicle stands at one of them
// (8 cm) that is the only answer.
std::vector<LeadIn> lead_ins(const geometry::Path& path, double arc_m, const GridFrame& frame);

// Whether the outline meets nothing on the map anywhere along the path.
bool is_free(const geometry::Path& path, const geometry::Footprint& outline, const OccupancyGrid& map);

}  // namespace stepwright::fleet
