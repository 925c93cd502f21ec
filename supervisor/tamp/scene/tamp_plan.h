#pragma once

// A plan of actions with the motions that do it. Values; any thread.
//
//   for (const PlannedAction& each : plan.actions) puts(text_of(cell, each.what).c_str());

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/motion/path/path.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::scene {

enum class ActionKind : std::uint8_t { Pick, Place, MoveAway };

// Numbers of the cell.
struct ActionSpec {
  ActionKind kind = ActionKind::MoveAway;
  int arm = 0;
  int thing = 0;
  int surface = -1;  // of a place: one of the two
  int on = -1;       // of a place: another thing
  friend bool operator==(const ActionSpec&, const ActionSpec&) = default;
};

enum class Phase : std::uint8_t { Lift, Transfer, Lower };

struct Motion {
  Phase phase = Phase::Transfer;
  double half_open_m = 0.0;  // half the way between the arm's fingers meanwhile
  motion::JointPath path;    // of the arm
};

struct PlannedAction {
  ActionSpec what;
  double hand_rad = 0.0;  // of a pick: the hand's angle, seen from the thing
  Pose pose;              // of the thing afterwards (place), or where it was grasped
  std::vector<Motion> motions;
};

struct TampPlan {
  std::vector<PlannedAction> actions;
};

// "right picks cup1", "right places cup1 on tray", "right places can2 on can1", "right moves away from cup1".
std::string text_of(const RobotCell& cell, const ActionSpec& action);
const char* name_of(Phase phase);

}  // namespace stepwright::tamp::scene
