#pragma once

// The bodies of an arm as a few capsules on its joints, and the joints as a controller computes them: what
// ARM_MODEL of the function blocks holds (ladder/doc/axes_group.md, Interlock of two arms), and what locks
// are made with. Every point of the arm's bodies lies within a capsule, whatever its fingers do.
//
// Values and pure functions; any thread. All frames are the robot's root.
//
//   const ArmCapsules left = arm_capsules(cell, 0);
//   distance_of(capsules_at(left, q1), capsules_at(right, q2));

#include <array>
#include <span>
#include <vector>

#include "supervisor/motion/spatial/transform.h"
#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::schedule {

// In the frame of a joint, behind its turn; joints count from 1.
struct Capsule {
  int joint = 1;
  motion::Vector3 from, to;
  double radius_m = 0.0;
};

struct ArmCapsules {
  // Where a joint is in the frame of the one before; it turns about its z.
  std::array<motion::Transform, 7> joints;
  std::vector<Capsule> capsules;  // in the order of their joints
};

ArmCapsules arm_capsules(const scene::RobotCell& cell, std::size_t arm);

// A thing as it is held by that arm, on the last joint; `hand_rad` of the hand, seen from the thing.
Capsule held_capsule(const scene::RobotCell& cell, std::size_t arm, std::size_t thing, double hand_rad);

// Where they are; the joint of each is of no meaning any more.
std::vector<Capsule> capsules_at(const ArmCapsules& arm, std::span<const double> joints);

// `empty` with what the arm holds in that state.
ArmCapsules with_held(ArmCapsules empty, const scene::RobotCell& cell, const scene::GeometricState& state,
                      std::size_t arm);
// Where all arms but that one are in that state, with what they hold; `empty`: of each arm.
std::vector<Capsule> others_at(std::span<const ArmCapsules> empty, const scene::RobotCell& cell,
                               const scene::GeometricState& state, std::size_t arm);

// Least distance; below zero where two overlap.
double distance_of(const Capsule& a, const Capsule& b);
double distance_of(std::span<const Capsule> a, std::span<const Capsule> b);

}  // namespace stepwright::tamp::schedule
