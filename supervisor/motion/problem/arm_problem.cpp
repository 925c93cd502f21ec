#include "supervisor/motion/problem/arm_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "runtime/ground/files/files.h"
#include "runtime/ground/result/closest.h"
#include "supervisor/motion/moveit/moveit_scene.h"
#include "supervisor/motion/scene/scene_file.h"

namespace stepwright::motion {

namespace {

// The scene is left in the state of its file: the request says what is other at the start.
result::Result<void> load_moveit(const ArmModel& model, const std::filesystem::path& file,
                                 ArmProblem& problem, MoveItScene& read) {
  const auto text = files::read_file(file.string(), kMostYamlBytes + 1);
  if (!text) return tl::unexpected(text.error());
  auto scene = read_moveit_scene(*text, file.string(), &model.meshes);
  if (!scene) return result::forward(scene);
  auto attached = attached_to(model.robot, *scene);
  if (!attached) return result::forward(attached);
  problem.attached = std::move(*attached);
  auto rest = values_for(model.robot, scene->state, std::move(problem.rest));
  if (!rest) return result::forward(rest);
  problem.rest = std::move(*rest);
  read = std::move(*scene);
  return {};
}

// Frames of links are where they are at the start.
result::Result<void> place_moveit(const ArmModel& model, MoveItScene& scene, ArmProblem& problem) {
  if (auto placed = place_framed(model.robot, problem.rest, scene); !placed) return placed;
  if (!problem.semantics && !(scene.allowed.empty() && scene.allowed_with_all.empty()))
    problem.semantics = joined_pairs(model.robot);
  if (problem.semantics) allow_pairs(model.robot, scene, *problem.semantics);
  problem.world = std::move(scene.world);
  constexpr double kDeeper_m = 0.05;  // boards of furniture are drawn through each other
  constexpr std::size_t kMostTold = 3;
  problem.notes = overlaps(problem.world, scene.places, kDeeper_m, kMostTold);
  return {};
}

// A link or thing that an allowed pair of a scene of ours names and nobody has.
result::Result<void> check_allowed(const ArmModel& model, const SceneFile& scene) {
  std::vector<std::string> links, things;
  for (const Link& each : model.robot.links) links.push_back(each.name);
  for (const Obstacle& each : scene.world.obstacles) things.push_back(each.name);
  result::Diagnostics wrong;
  for (std::size_t k = 0; k < scene.world.allowed.size(); ++k) {
    const auto& [link, thing] = scene.world.allowed[k];
    const auto check = [&](const std::string& name, const std::vector<std::string>& known, const char* what) {
      if (std::ranges::find(known, name) != known.end()) return;
      const std::string* meant = result::closest(name, known, 2);
      wrong.push_back({code::kNotOfRobot, result::Severity::Error, scene.allowed_at[k],
                       std::string("there is no ") + what + " '" + name + "'",
                       meant ? "did you mean '" + *meant + "'?" : ""});
    };
    check(link, links, "link");
    check(thing, things, "thing");
  }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return {};
}

result::Result<void> load_toml(const ArmModel& model, const std::filesystem::path& file,
                               ArmProblem& problem) {
  auto scene = load_scene(file);
  if (!scene) return result::forward(scene);
  if (auto known = check_allowed(model, *scene); !known) return known;
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

// Joints of the group whose start is nowhere said.
void tell_unsaid(const ArmModel& model, const std::vector<int>& coordinates,
                 std::initializer_list<const std::vector<JointValue>*> states, const std::string& file,
                 result::Diagnostics& notes) {
  std::string names;
  for (const int each : coordinates) {
    const std::string& name = model.robot.coordinates[static_cast<std::size_t>(each)].name;
    const bool said = std::ranges::any_of(states, [&](const std::vector<JointValue>* state) {
      return std::ranges::find(*state, name, &JointValue::joint) != state->end();
    });
    if (!said) names += (names.empty() ? "'" : ", '") + name + "'";
  }
  if (!names.empty())
    notes.push_back({code::kNotSaid,
                     result::Severity::Warning,
                     {file},
                     "nothing says where " + names + " is at the start: 0 is taken",
                     "'start_state', or 'robot_state' of the scene"});
}

// A joint without ends goes the short way round.
double turned_near(double value, double from, const Coordinate& limits) {
  if (std::isfinite(limits.lower) || std::isfinite(limits.upper)) return value;
  return from + std::remainder(value - from, 2.0 * std::numbers::pi);
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
  problem.rest.assign(model.robot.coordinates.size(), 0.0);
  const bool ours = scene.extension() == ".toml";
  MoveItScene of_moveit;
  if (auto read = ours ? load_toml(model, scene, problem) : load_moveit(model, scene, problem, of_moveit);
      !read)
    return result::forward(read);
  const auto text = files::read_file(request.string(), kMostYamlBytes + 1);
  if (!text) return tl::unexpected(text.error());
  auto asked = read_moveit_request(*text, request.string());
  if (!asked) return result::forward(asked);
  auto coordinates = coordinates_of(model, *asked, request.string());
  if (!coordinates) return result::forward(coordinates);
  auto rest = values_for(model.robot, asked->start, problem.rest);
  if (!rest) return result::forward(rest);
  const auto end = values_for(model.robot, asked->goal, *rest);
  if (!end) return tl::unexpected(end.error());
  problem.rest = std::move(*rest);
  if (!ours)
    if (auto placed = place_moveit(model, of_moveit, problem); !placed) return result::forward(placed);
  tell_unsaid(model, *coordinates, {&of_moveit.state, &asked->start}, request.string(), problem.notes);
  problem.group = asked->group;
  problem.coordinates = std::move(*coordinates);
  for (const int each : problem.coordinates) {
    const auto k = static_cast<std::size_t>(each);
    const Coordinate& limits = model.robot.coordinates[k];
    problem.from.push_back(brought(problem.rest[k], limits, rounded));
    problem.to.push_back(brought(turned_near((*end)[k], problem.rest[k], limits), limits, rounded));
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
