#pragma once

// The bodies of a hand as upright ones, for a hand that hangs down: all links that the arm's last joint
// carries, but for round ones far above the fingers nothing is left out.
//
// A pure function; any thread.

#include <vector>

#include "supervisor/motion/robot/robot.h"
#include "supervisor/tamp/scene/upright.h"

namespace stepwright::tamp::scene {

// In the tool's frame (x forward, y aside, z down): heights are below the tool's centre.
struct HandPart {
  bool round = false;
  double x_m = 0.0, y_m = 0.0, turn_rad = 0.0;
  double radius_m = 0.0, half_x_m = 0.0, half_y_m = 0.0;
  double from_m = 0.0, to_m = 0.0;  // along z
};

// `tip` is the tool's link, `carrier` the link that the last joint moves; `rest` has a value for each
// coordinate, the fingers' among them. Bodies that do not stand along z become cylinders that contain them.
std::vector<HandPart> hand_parts(const motion::Robot& robot, int carrier, int tip,
                                 const std::vector<double>& rest);

// Where a part is if the tool is at this place, hanging down, its x axis at the angle; `sweep_m` is how far
// up it goes from there.
Upright placed(const HandPart& part, double x_m, double y_m, double z_m, double angle_rad, double sweep_m);

}  // namespace stepwright::tamp::scene
