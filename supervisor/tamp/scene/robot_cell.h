#pragma once

// A cell of arms, furniture, surfaces and things as task planning with geometry sees it: all that does not
// change while a plan is looked for. Frames are the robot's root, z up; metres and radians.
//
// Does not change after it was made; any thread.
//
//   auto file = load_cell("p1.toml");                 // cell_file.h
//   const RobotCell& cell = file->cell;
//   const int cup = cell.thing("cup1");

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/collision/collision_checker.h"
#include "supervisor/motion/kinematics/srs_arm.h"
#include "supervisor/motion/mesh/link_meshes.h"
#include "supervisor/motion/robot/semantics.h"
#include "supervisor/tamp/scene/hand_parts.h"
#include "supervisor/tamp/scene/upright.h"

namespace stepwright::tamp::scene {

using JointValues = std::array<double, 7>;

// Something that is moved.
struct Thing {
  std::string name;
  Form form;
  Pose start;
  bool turns = false;    // its angle matters (a handle): a place has to choose one
  bool carries = false;  // others may be put on it
  std::string kind{};    // what a camera calls it: "cup", "can", "tray", "box"; empty: none of them
};

// Something that stands for good: a table, a box, a tray.
struct Furniture {
  std::string name;
  Form form;
  Pose pose;
};

// A rectangle on which things are put: all of their footprint lies within it.
struct Surface {
  std::string name;
  Pose middle;
  double size_x_m = 0.0, size_y_m = 0.0;
};

struct ArmNames {
  std::string name;     // in tasks
  std::string group;    // of SRDF: a chain of seven joints
  std::string gripper;  // the joint of its fingers
};

struct ArmModel {
  std::string name;
  motion::Chain chain;
  motion::SrsArm kinematics;
  std::vector<int> coordinates;
  int tip = 0;      // link
  int carrier = 0;  // the link that the last joint moves
  int gripper = 0;  // coordinate
  JointValues home{};
  motion::Transform base;  // of the chain, in the root's frame
  // Of the hand around each thing: opened before and after, and closed on it.
  std::vector<std::vector<HandPart>> hand_of;
};

// How hands go about it.
struct Manner {
  double depth_m = 0.02;         // of the tool's centre below the top of what it grasps
  double lift_m = 0.16;          // of the straight lines up and down
  double line_step_m = 0.0107;   // between configurations of a line: 16 of 0.16 m, a batch of checks
  double opening_m = 0.005;      // between a finger and the thing before it closes
  double clearance_m = 0.001;    // of hands from other things
  double things_apart_m = 2e-4;  // of things from each other
  std::size_t grasps = 16;       // samples of the hand's angle
  std::size_t places = 120;      // samples of a place
  std::size_t path_nodes = 500;  // of the planner of paths, each time
};

struct RobotCell {
  motion::Robot robot;
  motion::Semantics semantics;
  motion::Bodies bodies;
  motion::SphereModel spheres;
  std::vector<double> rest;  // of all coordinates: arms at home
  std::vector<ArmModel> arms;
  std::vector<Furniture> furniture;
  std::vector<Surface> surfaces;
  std::vector<Thing> things;
  std::vector<motion::LinkSpheres> thing_spheres;  // around each of them, in its own frame
  Manner manner;
  // What is taken to stand where a camera reports an obstacle: at least as large as whatever it calls so.
  Form obstacle{.round = true, .radius_m = 0.08, .height_m = 0.3};

  // Their numbers; -1: there is none of that name.
  int arm(std::string_view named) const;
  int surface(std::string_view named) const;
  int thing(std::string_view named) const;

  double tool_above(int thing) const {
    return things[static_cast<std::size_t>(thing)].form.height_m - manner.depth_m;
  }
  // Half the way between the fingers: closed on the thing, or open around it.
  double grip_m(int thing) const { return things[static_cast<std::size_t>(thing)].form.radius_m; }
  double open_m(int thing) const { return grip_m(thing) + manner.opening_m; }
};

// The arms of the names, their hands around each of the things. G0103: a name that the robot does not have,
// an arm that has no closed form, a thing that its fingers do not go around.
[[nodiscard]] result::Result<void> add_arms(RobotCell& cell, const std::vector<ArmNames>& names,
                                            const result::Location& where);

// Spheres around the robot's bodies and around things. Takes some tenths of a
// second.
void add_spheres(RobotCell& cell);

// The tool above a place, hanging down, x at the angle.
motion::Transform tool_pose(double x_m, double y_m, double z_m, double angle_rad);
// A thing's frame is in the middle of its underside.
motion::Transform frame_of(const Pose& pose);
// As an obstacle, with its sides and height less by `shrunk_m` on each side.
motion::Obstacle obstacle_of(const std::string& name, const Form& form, const Pose& pose,
                             double shrunk_m = 0.0);

// A thing that an arm holds, at a place in the frame of its tool.
motion::AttachedBody held_thing(const RobotCell& cell, std::size_t thing, const ArmModel& arm,
                                const motion::Transform& place, double shrunk_m);

// Where a thing is put on another one, which stands there: over its middle.
Pose top_of(const RobotCell& cell, int carrier, const Pose& stands, double angle_rad);
// Whether a thing at `above` stands on one at `below`.
bool stands_on(const Form& upper, const Pose& above, const Form& lower, const Pose& below);
// Whether all of one's footprint lies within the top of the other one, middle over middle.
bool fits_on(const Form& upper, const Form& lower);

// Whether all of the thing's footprint lies within the surface.
bool lies_within(const Surface& surface, const Form& form, const Pose& pose, double slack_m = 1e-9);

}  // namespace stepwright::tamp::scene
