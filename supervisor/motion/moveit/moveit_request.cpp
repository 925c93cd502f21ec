#include "supervisor/motion/moveit/moveit_request.h"

#include <algorithm>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/moveit/internal/yaml_reader.h"

namespace stepwright::motion {

namespace {

class RequestReader {
 public:
  explicit RequestReader(std::string name) : reader_(std::move(name)) {}

  result::Result<MoveItRequest> read(std::string_view text) {
    const bool sound = reader_.read(text, [&](const YAML::Node& root) {
      request_.group = reader_.text(root, "group_name");
      read_start(reader_.member(root, "start_state", false));
      refuse_constraints(reader_.member(root, "path_constraints", false), "path_constraints");
      const YAML::Node trajectory = reader_.member(root, "trajectory_constraints", false);
      refuse_some(reader_.member(trajectory, "constraints", false), "trajectory_constraints");
      const YAML::Node all = reader_.member(root, "goal_constraints", true);
      const auto goals = reader_.items(all, "goal_constraints");
      if (goals.empty() && !all.IsNull())
        reader_.complain(code::kBadSceneMember, all, "'goal_constraints' has no goal");
      if (goals.size() > 1)
        reader_.complain(code::kNotRead, goals[1], "'goal_constraints' has more than one goal",
                         "one of them is read: a request for each");
      if (!goals.empty()) read_goal(goals.front());
    });
    if (!sound) return tl::unexpected(reader_.take());
    return std::move(request_);
  }

 private:
  void refuse_some(const YAML::Node& list, const char* name) {
    if (!list.IsNull() && list.size() > 0)
      reader_.complain(code::kNotRead, list, std::string("'") + name + "' are not read");
  }

  void refuse_constraints(const YAML::Node& given, const char* of) {
    for (const char* each :
         {"joint_constraints", "position_constraints", "orientation_constraints", "visibility_constraints"})
      refuse_some(reader_.member(given, each, false), of);
  }

  void add(std::vector<JointValue>& to, const YAML::Node& name, const YAML::Node& value) {
    const auto number = reader_.number(value, "position");
    if (!name.IsScalar())
      reader_.complain(code::kBadSceneMember, name, "the name of a joint is no text");
    else if (std::ranges::find(to, name.Scalar(), &JointValue::joint) != to.end())
      reader_.complain(code::kBadSceneMember, name, "the joint '" + name.Scalar() + "' is there twice");
    else if (number)
      to.push_back({name.Scalar(), *number, reader_.place(name)});
  }

  void read_start(const YAML::Node& state) {
    if (state.IsNull()) return;
    const YAML::Node hanging = reader_.member(state, "attached_collision_objects", false);
    if (!hanging.IsNull() && hanging.size() > 0)
      reader_.complain(code::kNotRead, hanging, "'attached_collision_objects' of the start are not read",
                       "those of the scene's 'robot_state' are");
    const YAML::Node joints = reader_.member(state, "joint_state", true);
    for (const auto& [name, value] : reader_.joint_state(joints)) add(request_.start, name, value);
  }

  void read_goal(const YAML::Node& goal) {
    for (const char* other : {"position_constraints", "orientation_constraints", "visibility_constraints"}) {
      const YAML::Node list = reader_.member(goal, other, false);
      if (!list.IsNull() && list.size() > 0)
        reader_.complain(code::kNotRead, list, std::string("'") + other + "' are not read",
                         "joint_constraints are");
    }
    for (const YAML::Node& each :
         reader_.items(reader_.member(goal, "joint_constraints", true), "joint_constraints")) {
      const YAML::Node name = reader_.member(each, "joint_name", true),
                       value = reader_.member(each, "position", true);
      if (!name.IsNull() && !value.IsNull()) add(request_.goal, name, value);
    }
  }

  internal::YamlReader reader_;
  MoveItRequest request_;
};

}  // namespace

result::Result<MoveItRequest> read_moveit_request(std::string_view text, std::string name) {
  return RequestReader(std::move(name)).read(text);
}

result::Result<std::vector<double>> values_for(const Robot& robot, const std::vector<JointValue>& given,
                                               std::vector<double> values) {
  std::vector<std::string> names;
  for (const Joint& each : robot.joints) names.push_back(each.name);
  for (const JointValue& each : given) {
    const int joint = robot.joint(each.joint);
    if (joint < 0) {
      const std::string* meant = result::closest(each.joint, names, 2);
      return result::fail(code::kNotOfRobot, each.where, "the robot has no joint '" + each.joint + "'",
                          meant ? "did you mean '" + *meant + "'?" : "");
    }
    const int coordinate = robot.coordinate(each.joint);
    if (coordinate >= 0) values[static_cast<std::size_t>(coordinate)] = each.value;
  }
  return values;
}

}  // namespace stepwright::motion
