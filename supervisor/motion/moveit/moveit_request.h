#pragma once

// Planning requests of MoveIt as files (moveit_msgs/MotionPlanRequest as YAML): a group, where the robot is,
// and the values that its joints are to have.
//
//   const auto request = read_moveit_request(text, "request0001.yaml");
//   const auto start = values_for(robot, request->start, std::vector<double>(robot.coordinates.size()));
//
// Functions without state; any thread. One goal, as values of joints, is read; goals as poses, several goals,
// constraints of the path and objects that hang on the robot at first are refused, since a path that does
// without them would be another one.

#include "supervisor/motion/moveit/moveit_scene.h"

namespace stepwright::motion {

struct MoveItRequest {
  std::string group;
  std::vector<JointValue> start;
  std::vector<JointValue> goal;
};

// Fails with A0401 to A0403.
[[nodiscard]] result::Result<MoveItRequest> read_moveit_request(std::string_view text, std::string name);

// `values` of a robot with those of the request put in. Joints that do not move by themselves are passed
// over. Fails with A0404.
[[nodiscard]] result::Result<std::vector<double>> values_for(const Robot& robot,
                                                             const std::vector<JointValue>& given,
                                                             std::vector<double> values);

}  // namespace stepwright::motion
