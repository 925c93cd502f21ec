#pragma once

// The figures of the sorting line and where its parts stand, SI units. plant_models/doc/conveyor.md draws
// them.
//
//            t1 <------------- lane --------------- t        a belt of its own, runs to the left
//            |push t                        push e |
//   infeed -> r -> d1 -> d2 -> ... -> e -> chute N+1         one belt each, runs to the right
//                  |push 1 |push 2
//               chute 1  chute 2

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plant_models/assemblies/belt_drive.h"
#include "plant_models/body2d/body_geometry.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

// A pusher: a paddle on a cylinder that moves out while its valve is on and back while it is off.
struct PusherParameters {
  double speed_out_m_s = 0.5;
  double speed_back_m_s = 0.6;
  double thickness_m = 0.04;
  double switch_m = 0.005;  // an end switch is closed within this of its end
};

struct LineParameters {
  std::size_t diverters = 2;     // 1..4; chutes are one more: the last one is the end of the line
  std::size_t boxes = 5;         // 1..9, numbered from 1 in the order in which they are announced
  double arrival_s = 1.0;        // mean time between the infeed being free and the next box on it
  double zone_m = 0.8;           // length of a belt of the main line
  double belt_m = 0.5;           // width of all belts
  double belt_grip = 0.5;        // friction of boxes on belts, on chutes and on the floor
  double chute_speed_m_s = 0.4;  // its rollers always run
  double box_friction = 0.25;    // between boxes, rails and paddles
  bool variety = true;           // sizes, masses, offsets and arrival times differ with the seed
  BeltDriveParameters drive{};
  PusherParameters pusher{};
  std::uint64_t seed = 1;
};

// Fails with one C0321 per figure that has no sense.
[[nodiscard]] result::Result<void> validate(const LineParameters& parameters);

// One box of the order list, as the seed makes it.
struct BoxData {
  body2d::Rectangle rectangle;
  double mass_kg = 3.0;
  double offset_m = 0.0;   // beside the middle of the infeed, when it arrives
  double angle_rad = 0.0;  // turned by this, when it arrives
  double wait_s = 0.0;     // after the infeed was free
  int colour = 1;          // 1..3
};
std::vector<BoxData> make_boxes(const LineParameters& parameters);

}  // namespace stepwright::assemblies
