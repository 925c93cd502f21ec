#include "cell/robot/robot_figures.h"

#include <string>
#include <utility>

#include "runtime/ground/files/files.h"
#include "supervisor/motion/kinematics/chain.h"
#include "supervisor/motion/robot/urdf_reader.h"

namespace stepwright::cell_robot {
namespace {

using assemblies::Frame;
using assemblies::kArmJoints;

Frame frame_of(const motion::Transform& transform) {
  Frame frame;
  frame.turn.m = transform.rotation.m;
  frame.place = {transform.position_m.x, transform.position_m.y, transform.position_m.z};
  return frame;
}

assemblies::Vec3 vec_of(motion::Vector3 v) {
  return {v.x, v.y, v.z};
}

result::Result<assemblies::ConvexSolid> solid_of(const motion::Shape& shape, const result::Location& where) {
  switch (shape.kind) {
    case motion::ShapeKind::Box:
      return assemblies::box_solid(vec_of(shape.size_m));
    case motion::ShapeKind::Cylinder:
      return assemblies::cylinder_solid(shape.radius_m, shape.length_m);
    case motion::ShapeKind::Sphere:
      return assemblies::ball_solid(shape.radius_m);
    case motion::ShapeKind::Mesh:
      break;
  }
  return result::fail("C0322", where,
                      "the simulated robot cell knows no meshes, and this robot has '" + shape.mesh + "'",
                      "give its links boxes, cylinders and spheres as <collision>");
}

class RobotReading {
 public:
  RobotReading(const motion::Robot& robot, const config::RobotCellPlantConfig& cell)
      : robot_(robot), cell_(cell) {}

  result::Result<void> fill(assemblies::RobotCellParameters& parameters) {
    for (const config::ArmConfig& arm : cell_.arms) {
      if (auto read = read_arm(arm); !read) return result::forward(read);
    }
    for (std::size_t link = 0; link < robot_.links.size(); ++link) {
      if (auto read = read_link(static_cast<int>(link), parameters); !read) return result::forward(read);
    }
    for (ArmReading& each : arms_) parameters.arms.push_back(std::move(each.figures));
    return {};
  }

 private:
  struct ArmReading {
    assemblies::ArmFigures figures;
    std::array<int, kArmJoints> links{};  // that each joint moves
    int gripper = -1;                     // coordinate
  };

  result::Result<void> read_arm(const config::ArmConfig& arm) {
    const auto refuse = [&](const std::string& why, const std::string& hint) {
      return result::fail("C0322", arm.where, "arm '" + arm.name + "': " + why, hint);
    };
    const int tip = robot_.link(arm.tip);
    if (tip < 0)
      return refuse("the robot has no link '" + arm.tip + "'", "tip = the link between the finger pads");
    const int gripper = robot_.coordinate(arm.gripper);
    if (gripper < 0)
      return refuse("the robot has no joint '" + arm.gripper + "' that moves",
                    "gripper = the joint of a finger");
    auto chain = motion::Chain::between(robot_, 0, tip);
    if (!chain) return result::forward(chain);
    if (chain->size() != kArmJoints)
      return refuse("there are " + std::to_string(chain->size()) + " joints above '" + arm.tip + "'",
                    "arms of seven joints are simulated");
    ArmReading read;
    read.figures.name = arm.name;
    read.figures.tool = frame_of(chain->tool());
    read.gripper = gripper;
    read.figures.most_opening_m = 2.0 * robot_.coordinates[static_cast<std::size_t>(gripper)].upper;
    for (std::size_t k = 0; k < kArmJoints; ++k) {
      const motion::ChainJoint& joint = chain->joints()[k];
      const motion::Coordinate& coordinate = robot_.coordinates[static_cast<std::size_t>(joint.coordinate)];
      if (joint.kind != motion::JointKind::Revolute)
        return refuse("joint '" + coordinate.name + "' does not turn within limits", "type=\"revolute\"");
      if (arm.start_rad[k] < joint.lower || arm.start_rad[k] > joint.upper)
        return refuse(
            "start_rad[" + std::to_string(k) + "] is beyond the limits of '" + coordinate.name + "'",
            "seven angles within the limits of the robot");
      read.figures.joints[k] = {frame_of(joint.before), vec_of(joint.axis), joint.lower, joint.upper,
                                coordinate.velocity_per_s};
      read.links[k] = motion::Robot::link_below(coordinate.joint);
    }
    read.figures.start_rad = arm.start_rad;
    arms_.push_back(std::move(read));
    return {};
  }

  // The arm and joint that a link hangs on, the last one of them; -1 for what stands.
  std::pair<int, int> joint_of(int link) const {
    for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
      for (std::size_t k = kArmJoints; k-- > 0;)
        if (robot_.hangs_below(link, arms_[arm].links[k]))
          return {static_cast<int>(arm), static_cast<int>(k)};
    }
    return {-1, -1};
  }

  result::Result<void> read_link(int link, assemblies::RobotCellParameters& parameters) {
    const auto [arm, joint] = joint_of(link);
    const int above =
        arm < 0 ? 0 : arms_[static_cast<std::size_t>(arm)].links[static_cast<std::size_t>(joint)];
    Frame frame;
    assemblies::Vec3 slide;
    for (int at = link; at != above; at = robot_.parent_link(at)) {
      const motion::Joint& moved = robot_.joints[static_cast<std::size_t>(motion::Robot::joint_above(at))];
      const Frame origin = frame_of(moved.origin);
      slide = origin.turn * slide;
      if (arm >= 0 && moved.coordinate == arms_[static_cast<std::size_t>(arm)].gripper)
        slide = slide + moved.multiplier * (origin.turn * vec_of(moved.axis));
      frame = origin * frame;
    }
    for (const motion::Shape& shape : robot_.links[static_cast<std::size_t>(link)].shapes) {
      auto solid = solid_of(shape, cell_.robot_where);
      if (!solid) return result::forward(solid);
      const Frame place = frame * frame_of(shape.origin);
      if (arm < 0)
        parameters.fixed.push_back(
            {robot_.links[static_cast<std::size_t>(link)].name, *solid, place, false, true});
      else
        arms_[static_cast<std::size_t>(arm)].figures.bodies.push_back(
            {static_cast<std::size_t>(joint), *solid, place, slide});
    }
    return {};
  }

  const motion::Robot& robot_;
  const config::RobotCellPlantConfig& cell_;
  std::vector<ArmReading> arms_;
};

}  // namespace

result::Result<void> read_robot(const config::RobotCellPlantConfig& cell,
                                assemblies::RobotCellParameters& parameters) {
  auto text = files::read_file(cell.robot.string());
  if (!text) return result::forward(text);
  auto robot = motion::read_urdf(*text, cell.robot.string());
  if (!robot) return result::forward(robot);
  return RobotReading(*robot, cell).fill(parameters);
}

}  // namespace stepwright::cell_robot
