#pragma once

// YAML as readers of MoveIt's files need it: members by name, numbers within bounds, messages with their
// places. Internal to this folder; yaml-cpp's exceptions end here.

#include <yaml-cpp/yaml.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/spatial/transform.h"

namespace stepwright::motion::internal {

class YamlReader {
 public:
  static constexpr std::size_t kMostMessages = 100;

  explicit YamlReader(std::string file) : file_(std::move(file)) {}

  // Parses and reads; what is wrong, exceptions too, is in take().
  bool read(std::string_view text, const std::function<void(const YAML::Node&)>& reading);
  result::Diagnostics take() { return std::move(found_); }

  void complain(const char* code, const YAML::Node& at, std::string message, std::string hint = {});
  result::Location place(const YAML::Node& at) const;

  // A null node where it is missing; `needed`: and a message at `in`.
  YAML::Node member(const YAML::Node& in, const char* name, bool needed);
  // The items of a list; none, and a message where it is something else. A missing list has none.
  std::vector<YAML::Node> items(const YAML::Node& list, const char* name);
  std::string text(const YAML::Node& in, const char* name);
  std::optional<double> number(const YAML::Node& node, const char* what);
  // As many numbers as `count`, or none and a message.
  std::vector<double> numbers(const YAML::Node& node, const char* what, std::size_t count);
  // The same, or a map of these members, as messages are printed.
  std::vector<double> numbers(const YAML::Node& node, const char* what, std::span<const char* const> members);
  // Names and positions of a joint_state, in pairs.
  std::vector<std::pair<YAML::Node, YAML::Node>> joint_state(const YAML::Node& joints);
  // {position, orientation}, the latter as x, y, z, w; missing ones are zero and none.
  Transform pose(const YAML::Node& node, const char* where = "position", const char* turn = "orientation");

 private:
  std::string file_;
  result::Diagnostics found_;
};

}  // namespace stepwright::motion::internal
