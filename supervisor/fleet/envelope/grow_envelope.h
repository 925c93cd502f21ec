#pragma once

// From a path to a trajectory envelope: convex polygons that grow along it until they meet obstacles (Pecora
// and Cirillo 2012, "Spatial envelope generation"), and bounds on the time in each.
//
// Functions without state; any thread. What holds for every result (the paper admits that its polygons need
// not overlap):
//  - Each polygon is free of obstacles and on the map.
//  - At every pose of the path from entry to exit of a polygon the whole outline is inside it.
//  - The first polygon is entered at the path's begin, the last one left at its end; polygon k + 1 is entered
//  no
//    later than polygon k is left, at whose exit the whole outline is in both: consecutive polygons overlap
//    by the vehicle's area at least.
// Between poses it holds too where they are at most 0.1 m apart, the curvature stays the same from one to the
// next, and the vehicle turns with a radius of 3 m or more.
//
// grow_between_stands promises the same of a path on which the vehicle stands now and then: where it begins,
// at each stop, at its end. It lays a small polygon around each stand, in which the vehicle arrives, stands
// for the service and waits, so that who stands takes no more of the floor than he needs; and where it goes
// on, a second one that begins with the end of the service. The exit of the first one is the end of the
// service.
//
//   const auto grown = grow_envelope(map, vehicle.footprint(), "v1", answer.path->poses, {});
//   if (!grown) std::cerr << to_string(grown.error());

#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/envelope/time_bounds.h"
#include "supervisor/fleet/envelope/trajectory_envelope.h"
#include "supervisor/geometry/path.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

struct EnvelopeOptions {
  double growth_m = 0.5;        // each side moves outwards by no more than this
  double stretch_m = 3.0;       // of the path that a polygon is laid around before its sides grow
  double growth_step_m = 0.1;   // in steps of this
  double stand_growth_m = 0.2;  // instead of growth_m around the stands of grow_between_stands
  SpeedLimits speed{};
};

// The poses of the path between which a polygon holds the vehicle, and how far along the path they lie.
struct Visit {
  std::size_t first_pose = 0;
  std::size_t last_pose = 0;
  double entry_m = 0.0;
  double exit_m = 0.0;
  // It stands for at least so long at its last pose; part of the stay.
  std::chrono::milliseconds service{0};
};

// Where a vehicle comes to rest on its path.
struct Stand {
  std::size_t pose = 0;
  std::chrono::milliseconds service{0};
};

struct GrownEnvelope {
  TrajectoryEnvelope envelope;
  std::vector<Visit> visits;        // one for each polygon
  std::vector<std::size_t> stands;  // of grow_between_stands: the polygon in which each stand's service ends
};

// F0501: the path is empty, or a pose is not finite, or the way along it falls. F0502: speeds. F0504: growth.
// F0503: at a pose, or between it and the next one, the vehicle meets an obstacle or the border of the map.
[[nodiscard]] result::Result<GrownEnvelope> grow_envelope(const OccupancyGrid& map,
                                                          const geometry::Footprint& footprint,
                                                          const std::string& vehicle,
                                                          const geometry::Path& path,
                                                          const EnvelopeOptions& options);

// Stands in the order of the path; its begin and its end need not be named. Fails as grow_envelope, and with
// F0505 where stands are not in order.
[[nodiscard]] result::Result<GrownEnvelope> grow_between_stands(
    const OccupancyGrid& map, const geometry::Footprint& footprint, const std::string& vehicle,
    const geometry::Path& path, std::span<const Stand> stands, const EnvelopeOptions& options);

// One part of a path after the other, each with its own options: tight ones where the vehicle begins or
// rests.
struct EnvelopePart {
  std::size_t last_pose = 0;  // of the path; where the next part begins
  EnvelopeOptions options;    // but for the speeds, which are those of the first part
};

// Polygons of a part end with its last pose, in which the next one begins. Requires parts in the order of the
// path, the last one up to its end. Fails as grow_envelope.
[[nodiscard]] result::Result<GrownEnvelope> grow_in_parts(const OccupancyGrid& map,
                                                          const geometry::Footprint& footprint,
                                                          const std::string& vehicle,
                                                          const geometry::Path& path,
                                                          std::span<const EnvelopePart> parts);

// The same polygons at other speeds. Requires limits that `check` accepts.
void set_times(GrownEnvelope& grown, const SpeedLimits& speed);

}  // namespace stepwright::fleet
