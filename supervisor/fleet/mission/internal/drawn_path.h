#pragma once

// Paths that people drew or recorded, as poses: made dense enough for envelopes, and held against what the
// vehicle can drive. Pure functions.

#include <optional>
#include <span>
#include <string>

#include "supervisor/fleet/lattice/vehicle_model.h"
#include "supervisor/geometry/path.h"

namespace stepwright::fleet::internal {

struct DrawnPath {
  geometry::Path path;
  std::size_t wrong = 0;  // the pose that cannot be reached from the one before
  std::string fault;      // empty if all is well
};

// Two poses up to 0.1 m apart are joined by a straight line. Those farther apart are joined by the one arc of
// a circle that leads from one to the other along their headings, forward or in reverse; headings may be off
// by three degrees, the turning radius by a tenth.
DrawnPath join_poses(std::span<const geometry::Pose> poses, const VehicleModel& model);

}  // namespace stepwright::fleet::internal
