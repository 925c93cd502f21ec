#pragma once

// A mission as a graph of nodes along its path: where it begins and ends, stops, changes of direction, and
// hand-overs from polygon to polygon.
//
// A hand-over is a pose at which the whole outline is in both polygons, the one with most room on all sides.
// A vehicle that waits there for the next polygon is still within the one that it has; one that drives on is
// within the next one already. The deviation that a node allows leaves the outline within the polygons that
// the node belongs to, whichever way the vehicle deviates; but at the first one, where the vehicle stands
// already. Between two nodes the vehicle is within one polygon.
//
// Pure functions; any thread. Requires a path of one pose at least and what grow_envelope made of it.
//
//   const Route route = route_of(mission, {});
//   route.nodes[3].polygon;   // needed to drive on from there

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet::vda5050 {

struct RouteOptions {
  double most_deviation_m = 0.2;  // of nodes that are driven over
  double most_deviation_rad = 0.2;
  double stop_deviation_m = 0.05;  // where the vehicle stops to work
  double stop_deviation_rad = 0.05;
  double start_deviation_m = 0.2;  // a vehicle that stands within it takes the order
  double start_deviation_rad = 0.2;
  double trajectory_tolerance_m = 0.002;  // between the path and the polygon through fewer of its poses
};

struct RouteNode {
  std::size_t pose = 0;       // index into the path
  std::uint32_t polygon = 0;  // within which it drives on
  double deviation_m = 0.0;
  double deviation_rad = 0.0;
  std::vector<std::size_t> stops;  // indices, ascending
};

struct Route {
  std::vector<RouteNode> nodes;  // in the order of the path; the first one is at `from`
};

// From the pose `from` on, which becomes a node.
Route route_of(const VehicleMission& mission, const RouteOptions& options, std::size_t from = 0);

// Poses `first` to `last` of the path without those that lie within `tolerance_m` of the chord of others.
std::vector<geometry::PathPose> thinned(const geometry::Path& path, std::size_t first, std::size_t last,
                                        double tolerance_m);

// Least distance from a corner of the outline to a side of the polygon; negative where one is outside.
double room_m(const geometry::ConvexPolygon& polygon, const geometry::Pose& pose,
              const geometry::Footprint& footprint);

}  // namespace stepwright::fleet::vda5050
