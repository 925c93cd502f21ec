#pragma once

// Model of a vehicle for path planners: its outline and how tightly it turns.
//
// A value. The reference point lies on the axle that does not steer, in the middle; a counterbalanced
// forklift steers with its rear wheels, so that this is the axle below the mast and "forward" is where the
// forks point.
//
//   const auto wrong = check(vehicle, {"fleet.json", 4, 3}, "vehicles[0].");
//   if (result::has_errors(wrong)) ...

#include <string_view>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::fleet {

struct VehicleModel {
  double wheelbase_m = 1.9;           // between the axles
  double min_turning_radius_m = 3.5;  // of the reference point
  double max_steering_rad = 0.0;      // of a single wheel in the middle of the steered axle; 0 = not told
  double front_m = 1.6;               // from the reference point to the foremost point, forks included
  double rear_m = 2.4;
  double width_m = 1.4;

  geometry::Footprint footprint() const { return {front_m, rear_m, 0.5 * width_m}; }
  double largest_curvature_1pm() const { return 1.0 / min_turning_radius_m; }
  // Radius of the largest circle around the reference point that the outline holds.
  double inscribed_radius_m() const;
  // Distance from the reference point to the farthest corner.
  double circumscribed_radius_m() const;

  friend bool operator==(const VehicleModel&, const VehicleModel&) = default;
};

// F0201: a value that is no length of a vehicle; F0202: values that contradict each other. Each message names
// the key (the field's name behind `prefix`); empty if all is well.
result::Diagnostics check(const VehicleModel& vehicle, const result::Location& where,
                          std::string_view prefix);

}  // namespace stepwright::fleet
