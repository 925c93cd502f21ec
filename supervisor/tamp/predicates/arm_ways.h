#pragma once

// All ways in which an arm can stand with its tool at a place and go straight up from there: branches and
// swivels of the closed form that keep all limits at both ends.
//
// A function without state; any thread.

#include <optional>
#include <vector>

#include "supervisor/motion/path/path.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::predicates {

struct ToolPlace {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0, angle_rad = 0.0;
  friend bool operator==(const ToolPlace&, const ToolPlace&) = default;
};

struct ArmWay {
  double swivel_rad = 0.0;
  motion::SrsBranch branch;
  scene::JointValues top{};
  double far = 0.0;  // from where the arm is, in the measure of joint_distance
};

// Of each arc of swivels that holds below and above: its middle, and where it is wide two more. The nearest
// first. None: it is proved that the arm cannot be there, or not go up from there.
std::vector<ArmWay> arm_ways(const scene::ArmModel& arm, const ToolPlace& place, double lift_m,
                             const scene::JointValues& from);

// The two steps of it: all ways, wherever the arm is; then the nearest first.
std::vector<ArmWay> all_ways(const scene::ArmModel& arm, const ToolPlace& place, double lift_m);
void sort_ways(std::vector<ArmWay>& ways, const scene::JointValues& from);

// From the bottom up in steps. Nothing where a limit is not kept on the way, or joints jump.
std::optional<motion::JointPath> line_of(const scene::ArmModel& arm, const ToolPlace& place, double lift_m,
                                         double step_m, const ArmWay& way);

}  // namespace stepwright::tamp::predicates
