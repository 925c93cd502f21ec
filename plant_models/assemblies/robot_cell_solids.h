#pragma once

// Convex solids and the distance of two of them: what the judge of the robot cell sees with. It shares no
// code with the planner's checkers, on purpose. Pure functions; any thread, no heap.
//
//   const PlacedSolid cup{cylinder_solid(0.035, 0.10), frame};
//   if (solid_distance_m(cup, finger) < 0.0) ...               // they share points
//
// A solid is a box or a cylinder around its frame's origin, grown by `round_m`: a ball is a box without
// sides. The distance is that of Gilbert, Johnson and Keerthi (IEEE J. Robotics and Automation 4(2), 1988)
// between the cores, less both roundings.

#include <cstdint>

#include "plant_models/assemblies/robot_cell_space.h"

namespace stepwright::assemblies {

enum class SolidKind : std::uint8_t { Box, Cylinder };  // a cylinder lies along z

struct ConvexSolid {
  SolidKind kind = SolidKind::Box;
  Vec3 half_m;  // of the core; a cylinder's radius is x, half of its length z
  double round_m = 0.0;

  friend bool operator==(const ConvexSolid&, const ConvexSolid&) = default;
};

// Corners of boxes and cylinders are rounded by this, so that a small depth can be measured; at most the half
// of the least side.
inline constexpr double kCornerRound_m = 0.0005;
// What is in one another by no more than this touches as things that stand or are held do: no contact.
inline constexpr double kContactDepth_m = 0.0005;

ConvexSolid box_solid(Vec3 sides_m);
ConvexSolid cylinder_solid(double radius_m, double length_m);
ConvexSolid ball_solid(double radius_m);

struct PlacedSolid {
  ConvexSolid solid;
  Frame frame;
};

// From the frame's origin to the farthest point.
double bound_m(const ConvexSolid& solid);

// Of the surfaces; 0 or less where they touch or share points: then how deep they are in one another, but
// never less than minus both roundings.
double solid_distance_m(const PlacedSolid& a, const PlacedSolid& b);

// At most solid_distance_m(), at a fraction of the cost.
inline double least_distance_m(const PlacedSolid& a, const PlacedSolid& b) {
  return length(a.frame.place - b.frame.place) - bound_m(a.solid) - bound_m(b.solid);
}

}  // namespace stepwright::assemblies
