#pragma once

// Data of the blocks of axes, as initial values of ST: paths (MC_PATH, MC_WAY_POINT, MC_TIME_ROW), the model
// of an arm (ARM_MODEL), and the figures of its group (AXES_GROUP). Pure functions; any thread.
//
//   const std::string model = arm_model_literal(schedule::arm_capsules(cell, 0));
//   project.globals.push_back(global_variable("model_left", "ARM_MODEL", "for the interlock", {}, model));

#include <span>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "supervisor/motion/timing/motion_table.h"
#include "supervisor/tamp/schedule/arm_capsules.h"
#include "supervisor/tamp/schedule/arm_schedule.h"

namespace stepwright::tamp::program {

// The shortest text that is read as this LREAL: "0.1", "1.0e-05".
std::string lreal_literal(double value);

// "(Joints := 7, Joint := [...], Capsules := 7, Capsule := [...])"
std::string arm_model_literal(const schedule::ArmCapsules& arm);
// Statements: from now on the model has that body as its last capsule, behind `own` ones of the arm; or those
// alone.
std::string with_held_text(const std::string& model, std::size_t own, const schedule::Capsule& held);
std::string without_held_text(const std::string& model, std::size_t own);
inline constexpr std::size_t kMostCapsules = 12;  // of ARM_MODEL

// The limits of an arm; of its motions by themselves those of stops.
struct GroupFigures {
  std::vector<double> lower, upper, velocity, acceleration, jerk;
  double following_rad = 0.25;
};
std::string group_literal(const GroupFigures& figures);

// Three variables for a path, whose names end with a digest of what they hold.
struct PathData {
  graphic::Variable path, points, rows;
};
PathData path_data(const std::string& name, const motion::MotionTable& table, const std::string& comment);

inline constexpr std::size_t kWayPointBytes = 16 * 8;
inline constexpr std::size_t kTimeRowBytes = 8 * 8;

}  // namespace stepwright::tamp::program
