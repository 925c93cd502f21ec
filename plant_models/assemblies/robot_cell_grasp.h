#pragma once

// Grasp of a hand of two fingers: whether an object is between its pads, how it goes with the hand, and how
// it slides where friction does not hold it. Functions of values; any thread, no heap.
//
//   if (const auto fit = fit_between(tool, pose, part); fit && opening_m <= fit->width_m) ...   // held
//   slide(grasp, tool, {...});                          // every step; slid_m says how far so far
//   object.pose = carried(grasp, tool);
//
// Pads press along the tool's y axis, which is nearly level; friction is Coulomb's, with one coefficient.

#include <cstddef>
#include <optional>

#include "plant_models/assemblies/robot_cell_shapes.h"

namespace stepwright::assemblies {

// Half sides of a pad: across (the tool's x) and along the fingers (the tool's z).
inline constexpr double kPadAcross_m = 0.011;
inline constexpr double kPadAlong_m = 0.020;

struct Fit {
  double width_m = 0.0;  // between the pads when both touch
  double side_m = 0.0;   // how far the part is off the middle, along the tool's y
};

// Of a part with `grip` that the pads would press on if they closed; nothing where they would miss it, or
// meet it at a corner: more than 0.2 rad off a box's face, or the tool's y axis out of level.
std::optional<Fit> fit_between(const Frame& tool, const ObjectPose& pose, const ObjectPart& part);

struct Grasp {
  std::size_t object = 0;
  double width_m = 0.0;
  Vec3 offset;              // of the object's origin, in the tool's frame
  double turned_rad = 0.0;  // its yaw less the tool's
  Vec3 up;                  // the cell's z in the tool's frame when it was grasped
  Vec3 sliding_m_s;         // along the pads
  double slid_m = 0.0;
};

Grasp grasped(std::size_t object, double width_m, const Frame& tool, const ObjectPose& pose);
ObjectPose carried(const Grasp& grasp, const Frame& tool);
// How far the hand has tilted since.
double tilt_rad(const Grasp& grasp, const Frame& tool);

struct Holding {
  double mass_kg = 0.0;  // of the object and all that stands on it
  double force_n = 0.0;  // of each finger
  double friction = 0.0;
  Vec3 acceleration_m_s2;  // of the object, if it did not slide
  double step_s = 0.0;
};

// One step. Where more than 2 friction * force is needed along the pads, the object slides by what is
// missing.
void slide(Grasp& grasp, const Frame& tool, const Holding& holding);

}  // namespace stepwright::assemblies
