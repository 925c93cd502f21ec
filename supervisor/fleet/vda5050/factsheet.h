#pragma once

// Factsheet of a type of vehicle, what it is and can, for whoever sets it up (VDA 5050 2.1.0, section 6.15).
// A value; any thread may read.
//
//   const Factsheet sheet = factsheet_of(mission.model, mission.speed, header);
//   publish(to_json(sheet));

#include <string>
#include <vector>

#include "supervisor/fleet/envelope/time_bounds.h"
#include "supervisor/fleet/lattice/vehicle_model.h"
#include "supervisor/fleet/vda5050/header.h"

namespace stepwright::fleet::vda5050 {

// Properties of the type beyond outline and speed limits.
struct VehicleType {
  std::string series = "Stepwright forklift";
  double max_load_kg = 1000.0;
  double acceleration_mps2 = 0.5;
  double deceleration_mps2 = 0.8;
  double height_min_m = 2.2;  // load handling device down
  double height_max_m = 3.5;
  double wheel_diameter_m = 0.3;
  double wheel_width_m = 0.1;
  std::vector<std::string> load_positions = {"forks"};
};

struct Wheel {
  bool driven = false;
  bool steered = false;
  double x_m = 0.0;
  double y_m = 0.0;
};

struct Corner {
  double x_m = 0.0;
  double y_m = 0.0;
};

// The frame is the vehicle model's: origin on the axle that does not steer, x where the forks point.
struct Factsheet {
  Header header;
  VehicleType type;
  double speed_min_mps = 0.0;
  double speed_max_mps = 0.0;
  double length_m = 0.0;
  double width_m = 0.0;
  std::vector<Wheel> wheels;
  std::vector<Corner> outline;  // anticlockwise
};

// A forklift with two fixed wheels below the mast and one behind that drives and steers.
Factsheet factsheet_of(const VehicleModel& model, const SpeedLimits& speed, const Header& header,
                       const VehicleType& type = {});

}  // namespace stepwright::fleet::vda5050
