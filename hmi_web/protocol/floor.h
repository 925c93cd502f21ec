#pragma once

// A floor on which vehicles move freely, as a viewer draws it: metres, seen from above; x to the right, y
// upwards. Points are those of synoptic.h; an empty id is a part without a live value.
//
//   FloorMap map{.cell_m = 0.2, .columns = 10, .rows = 5, .outlines = {{3, 1, 2, 2, -2}}};
//   // one rack: columns 3 and 4 of the rows 1 and 2
//
// Plain values; no thread rule.

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::protocol {

// Closed lines around what is blocked. What lies inside of an odd number of them is blocked.
struct FloorMap {
  double low_x_m = 0;  // lower left corner
  double low_y_m = 0;
  double cell_m = 0;  // the outlines count in cells
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  // Each: column and row of a corner, then how far it goes on, along x, along y, along x and so on; the last
  // step, along y and back to the first corner, is left out.
  std::vector<std::vector<std::int32_t>> outlines;
};

// Its reference point is at x and y, the middle of the front axle, which does not steer.
struct Forklift {
  std::string id;
  std::string label;
  double front_m = 0;  // from the reference point to the tips of the forks
  double rear_m = 0;
  double width_m = 0;
  double wheelbase_m = 0;
  // As its own sensors measure it.
  std::string x_point;        // m
  std::string y_point;        // m
  std::string heading_point;  // rad
  std::string speed_point;    // m/s; negative in reverse
  std::string lock_point;     // steering, rad; positive turns left
  std::string loaded_point;   // switches
  std::string bumper_point;
  std::string enable_point;  // relays: the spring brake is off, the forks are to be up
  std::string lift_point;
  // Of a simulated plant.
  std::string true_x_point;
  std::string true_y_point;
  std::string true_heading_point;
  std::string carries_point;  // number of the pallet, from 1; 0 = none
};

// Of a simulated plant.
struct Pallet {
  std::string id;
  std::string label;
  double length_m = 0;
  double width_m = 0;
  std::string state_point;  // 1 = it stands on the floor, 2 = it is carried
  std::string x_point;
  std::string y_point;
  std::string angle_point;  // rad
};

// A place that can be blocked.
struct Blockage {
  std::string id;
  std::string label;
  double x_m = 0;  // its middle
  double y_m = 0;
  double angle_rad = 0;
  double length_m = 0;  // along the angle
  double width_m = 0;
  std::string there_point;  // 1 = something stands there; empty = always
};

struct Floor {
  std::vector<FloorMap> maps;  // none or one
  std::vector<Forklift> forklifts;
  std::vector<Pallet> pallets;
  std::vector<Blockage> blockages;
  std::string estop_ok_point;  // off while the emergency stop is pressed; of plants without a floor, too
};

}  // namespace stepwright::protocol
