#pragma once

// The geometric part of a state: where the arms are, where things stand, and who holds what with which grasp.
//
// A value, small enough to be copied for every action; any thread. Equal states have equal fingerprints.
//
//   GeometricState state = initial_state(cell);
//   state.things[cup].holder = right;

#include <cstdint>
#include <vector>

#include "supervisor/motion/path/path.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::scene {

struct ThingState {
  Pose pose;              // where it stands, or stood before it was picked
  int holder = -1;        // an arm
  double hand_rad = 0.0;  // of the hand that holds it: its x axis seen from the thing
  friend bool operator==(const ThingState&, const ThingState&) = default;
};

struct ArmState {
  JointValues at{};
  double half_open_m = 0.0;  // half the way between the fingers
  int holds = -1;            // a thing
  int near = -1;             // the thing around which its open fingers are
  // The straight line up from where it is; empty: it is not down at anything.
  motion::JointPath line;
  friend bool operator==(const ArmState&, const ArmState&) = default;
};

struct GeometricState {
  std::vector<ArmState> arms;
  std::vector<ThingState> things;
  friend bool operator==(const GeometricState&, const GeometricState&) = default;
};

GeometricState initial_state(const RobotCell& cell);

// 64 bits of all of it.
std::uint64_t fingerprint(const GeometricState& state);

// 64 bits of what an arm moves among and with: all but where it is itself, with its fingers so far open.
std::uint64_t fingerprint_around(const GeometricState& state, int arm, double half_open_m);

// A value for each coordinate of the robot.
std::vector<double> values_of(const RobotCell& cell, const GeometricState& state);

// What is around the robot, and what its hands hold.
struct Surroundings {
  motion::World world;  // furniture, and all things that nobody holds
  std::vector<motion::AttachedBody> held;
};
// `shrunk_m` is taken from the sides of what is held.
Surroundings surroundings(const RobotCell& cell, const GeometricState& state, double shrunk_m);

}  // namespace stepwright::tamp::scene
