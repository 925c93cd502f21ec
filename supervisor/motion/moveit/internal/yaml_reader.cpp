#include "supervisor/motion/moveit/internal/yaml_reader.h"

#include <cmath>
#include <utility>

#include "supervisor/motion/moveit/moveit_scene.h"

namespace stepwright::motion::internal {

namespace {

constexpr const char* kAxes[] = {"x", "y", "z", "w"};

result::Location located(const std::string& file, const YAML::Mark& mark) {
  const auto from_one = [](int k) { return k < 0 ? 0U : static_cast<std::uint32_t>(k) + 1; };
  return {file, from_one(mark.line), from_one(mark.column)};
}

}  // namespace

bool YamlReader::read(std::string_view text, const std::function<void(const YAML::Node&)>& reading) {
  const auto refuse = [&](result::Location where, std::string message) {
    found_.push_back({code::kBadYaml, result::Severity::Error, std::move(where), std::move(message), {}});
  };
  if (text.size() > kMostYamlBytes) {
    refuse({file_}, "the file is larger than 4 MiB");
    return false;
  }
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    if (root.IsMap())
      reading(root);
    else
      refuse({file_, 1, 1}, "the file holds no members");
  } catch (const YAML::Exception& problem) {
    refuse(located(file_, problem.mark), "this is no sound YAML: " + problem.msg);
  }
  return found_.empty();
}

result::Location YamlReader::place(const YAML::Node& at) const {
  return located(file_, at.Mark());
}

void YamlReader::complain(const char* code, const YAML::Node& at, std::string message, std::string hint) {
  if (found_.size() < kMostMessages)
    found_.push_back({code, result::Severity::Error, place(at), std::move(message), std::move(hint)});
}

YAML::Node YamlReader::member(const YAML::Node& in, const char* name, bool needed) {
  if (in.IsMap()) {
    const YAML::Node found = in[name];
    if (found.IsDefined() && !found.IsNull()) return found;
  }
  if (needed) complain(code::kBadSceneMember, in, std::string("'") + name + "' is missing");
  return {};
}

std::vector<YAML::Node> YamlReader::items(const YAML::Node& list, const char* name) {
  std::vector<YAML::Node> found;
  if (list.IsNull()) return found;
  if (!list.IsSequence())
    complain(code::kBadSceneMember, list, std::string("'") + name + "' is no list");
  else
    for (const auto& each : list) found.push_back(each);
  return found;
}

std::string YamlReader::text(const YAML::Node& in, const char* name) {
  const YAML::Node found = member(in, name, true);
  if (found.IsNull()) return {};
  if (!found.IsScalar()) {
    complain(code::kBadSceneMember, found, std::string("'") + name + "' is no text");
    return {};
  }
  return found.Scalar().substr(0, 256);
}

std::optional<double> YamlReader::number(const YAML::Node& node, const char* what) {
  constexpr double kLargest = 1e6;
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value)) {
    complain(code::kBadSceneMember, node, std::string("'") + what + "' is no number");
    return std::nullopt;
  }
  if (!(std::abs(value) <= kLargest)) {
    complain(code::kBadSceneMember, node, std::string("'") + what + "' is out of range");
    return std::nullopt;
  }
  return value;
}

std::vector<double> YamlReader::numbers(const YAML::Node& node, const char* what, std::size_t count) {
  std::vector<double> values;
  if (!node.IsSequence() || node.size() != count) {
    complain(code::kBadSceneMember, node,
             std::string("'") + what + "' is no list of " + std::to_string(count) + " numbers");
    return values;
  }
  for (const auto& each : node) {
    const auto value = number(each, what);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::vector<double> YamlReader::numbers(const YAML::Node& node, const char* what,
                                        std::span<const char* const> members) {
  if (!node.IsMap()) return numbers(node, what, members.size());
  std::vector<double> values;
  for (const char* name : members) {
    const YAML::Node found = member(node, name, true);
    const auto value = found.IsNull() ? std::nullopt : number(found, name);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::vector<std::pair<YAML::Node, YAML::Node>> YamlReader::joint_state(const YAML::Node& joints) {
  std::vector<std::pair<YAML::Node, YAML::Node>> all;
  if (joints.IsNull()) return all;
  const auto names = items(member(joints, "name", false), "name");
  const auto values = items(member(joints, "position", false), "position");
  if (names.size() != values.size())
    complain(code::kBadSceneMember, joints, "the state has not one position for each joint");
  else
    for (std::size_t k = 0; k < names.size(); ++k) all.emplace_back(names[k], values[k]);
  return all;
}

Transform YamlReader::pose(const YAML::Node& node, const char* where, const char* turn) {
  Transform place;
  if (const YAML::Node position = member(node, where, false); !position.IsNull()) {
    const auto at = numbers(position, where, std::span(kAxes).first(3));
    if (!at.empty()) place.position_m = {at[0], at[1], at[2]};
  }
  if (const YAML::Node orientation = member(node, turn, false); !orientation.IsNull()) {
    const auto q = numbers(orientation, turn, kAxes);
    if (q.empty()) return place;
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(square > 0.5 && square < 2.0))
      complain(code::kBadSceneMember, orientation, std::string("'") + turn + "' is no rotation",
               "a quaternion x, y, z, w of length 1");
    else
      place.rotation = from_quaternion(q[3], q[0], q[1], q[2]);
  }
  return place;
}

}  // namespace stepwright::motion::internal
