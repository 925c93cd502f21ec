#include "supervisor/motion/problem/arm_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "runtime/ground/process/files.h"
#include "runtime/ground/result/closest.h"
#include "supervisor/motion/moveit/moveit_scene.h"
#include "supervisor/motion/scene/scene_file.h"

namespace stepwright::motion {

namespace {

result::Result<void> load_moveit(const ArmModel& model, const std::filesystem::path& file,
                                 ArmProblem& problem) {
  const auto text = process::read_file(file.string(), kMostYamlBytes + 1);
  if (!text) return tl::unexpected(text.error());
  auto scene = read_moveit_scene(*text, file.string(), &model.meshes);
  if (!scene) return result::forward(scene);
  auto attached = attached_to(model.robot, *scene);
  if (!attached) return result::forward(attached);
  problem.attached = std::move(*attached);
  if (problem.semantics) allow_pairs(model.robot, *scene, *problem.semantics);
  problem.world = std::move(scene->world);
  constexpr double kDeeper_m = 0.05;  // boards of furniture are drawn through each other
  constexpr std::size_t kMostTold = 3;
  problem.notes = overlaps(problem.world, file.string(), kDeeper_m, kMostTold);
  return {};
}

result::Result<void> load_toml(const std::filesystem::path& file, ArmProblem& problem) {
  auto scene = load_scene(file);
  if (!scene) return result::forward(scene);
  problem.world = std::move(scene->world);
  problem.notes = std::move(scene->warnings);
  return {};
}

result::Result<std::vector<int>> coordinates_of(const ArmModel& model, const MoveItRequest& request,
                                                const std::string& file) {
  if (model.semantics) {
    if (const Group* group = model.semantics->group(request.group); group && !group->coordinates.empty())
      return group->coordinates;
    std::vector<std::string> names;
    for (const Group& each : model.semantics->groups) names.push_back(each.name);
    const std::string* meant = result::closest(request.group, names, 2);
    return result::fail(code::kNotOfRobot, {file},
                        "the robot has no group '" + request.group + "' that moves",
                        meant ? "did you mean '" + *meant + "'?" : "");
  }
  std::vector<int> named;
  for (const JointValue& each : request.goal)
    if (const int coordinate = model.robot.coordinate(each.joint); coordinate >= 0)
      named.push_back(coordinate);
  std::sort(named.begin(), named.end());
  named.erase(std::unique(named.begin(), named.end()), named.end());
  if (named.empty()) return result::fail(code::kNotOfRobot, {file}, "the goal names no joint that moves");
  return named;
}

// Limits to which values that are rounded beyond them are brought.
double brought(double value, const Coordinate& limits, double rounded) {
  if (value < limits.lower && value >= limits.lower - rounded) return limits.lower;
  if (value > limits.upper && value <= limits.upper + rounded) return limits.upper;
  return value;
}

}  // namespace

result::Result<ArmProblem> load_problem(const ArmModel& model, const std::filesystem::path& scene,
                                        const std::filesystem::path& request, double rounded) {
  ArmProblem problem;
  problem.semantics = model.semantics;
  if (auto read =
          scene.extension() == ".toml" ? load_toml(scene, problem) : load_moveit(model, scene, problem);
      !read)
    return result::forward(read);
  const auto text = process::read_file(request.string(), kMostYamlBytes + 1);
  if (!text) return tl::unexpected(text.error());
  auto asked = read_moveit_request(*text, request.string());
  if (!asked) return result::forward(asked);
  auto coordinates = coordinates_of(model, *asked, request.string());
  if (!coordinates) return result::forward(coordinates);
  auto rest = values_for(model.robot, asked->start, std::vector<double>(model.robot.coordinates.size()));
  if (!rest) return result::forward(rest);
  const auto end = values_for(model.robot, asked->goal, *rest);
  if (!end) return tl::unexpected(end.error());
  problem.group = asked->group;
  problem.coordinates = std::move(*coordinates);
  problem.rest = std::move(*rest);
  for (const int each : problem.coordinates) {
    const auto k = static_cast<std::size_t>(each);
    const Coordinate& limits = model.robot.coordinates[k];
    problem.from.push_back(brought(problem.rest[k], limits, rounded));
    problem.to.push_back(brought((*end)[k], limits, rounded));
  }
  return problem;
}

std::string beyond_limits(const ArmModel& model, const ArmProblem& problem, const Configuration& end) {
  for (std::size_t k = 0; k < end.size(); ++k) {
    const Coordinate& limits = model.robot.coordinates[static_cast<std::size_t>(problem.coordinates[k])];
    if (end[k] >= limits.lower && end[k] <= limits.upper) continue;
    char text[96];
    std::snprintf(text, sizeof text, " is %.4f, and goes from %.4f to %.4f", end[k], limits.lower,
                  limits.upper);
    return "'" + limits.name + "'" + text;
  }
  return {};
}

}  // namespace stepwright::motion
