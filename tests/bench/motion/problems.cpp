#include "tests/bench/motion/problems.h"

#include <algorithm>
#include <ctime>
#include <functional>
#include <stdexcept>

#include "supervisor/motion/moveit/moveit_request.h"
#include "supervisor/motion/path/certain_path.h"
#include "supervisor/motion/robot/srdf_reader.h"
#include "supervisor/motion/robot/urdf_reader.h"
#include "tests/bench/motion/scene.h"

namespace stepwright::bench {

namespace {

using namespace motion;
namespace fs = std::filesystem;

double milliseconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

class Problems {
 public:
  explicit Problems(const ProblemFolders& folders)
      : robot_(taken(read_urdf(text_of(folders.urdf), folders.urdf.string()))),
        semantics_(taken(read_srdf(text_of(folders.srdf), folders.srdf.string(), robot_))) {
    MeshLocator meshes(folders.urdf.parent_path());
    for (const auto& [beginning, folder] : folders.packages) meshes.map(beginning, folder);
    bodies_ = taken(read_bodies(robot_, meshes));
    spheres_ = cover(bodies_, {.protrusion_m = folders.protrusion_m, .most_per_body = folders.most_spheres});
    figures_.spheres = spheres_.count();
  }

  void plan(const fs::path& scene_file, const fs::path& request_file) {
    const auto scene = taken(read_moveit_scene(text_of(scene_file), scene_file.string()));
    const auto request = taken(read_moveit_request(text_of(request_file), request_file.string()));
    const Group* group = semantics_.group(request.group);
    if (!group) throw std::runtime_error(request_file.string() + ": no group '" + request.group + "'");
    const std::span<const int> coordinates = group->coordinates;
    const auto rest =
        taken(values_for(robot_, request.start, std::vector<double>(robot_.coordinates.size())));
    const auto end = taken(values_for(robot_, request.goal, rest));
    Configuration from, to;
    for (const int each : coordinates) {
      const Coordinate& limits = robot_.coordinates[static_cast<std::size_t>(each)];
      from.push_back(std::clamp(rest[static_cast<std::size_t>(each)], limits.lower, limits.upper));
      to.push_back(std::clamp(end[static_cast<std::size_t>(each)], limits.lower, limits.upper));
    }
    ++figures_.problems;
    const auto exact =
        taken(ExactChecker::make(robot_, bodies_, &semantics_, scene.world, coordinates, rest, &spheres_));
    if (exact.contact(from) || exact.contact(to)) {
      ++figures_.ends_collide_exactly;
      return;
    }
    const auto space = joint_space(robot_, coordinates);
    CertainPath answer;
    const double spent = milliseconds([&] {
      const auto checker =
          taken(CollisionChecker::make(robot_, spheres_, &semantics_, scene.world, coordinates, rest));
      const PathAnswer raw = plan_path(checker, space, from, {to});
      if (!raw.path.empty()) shorten(checker, raw.path);
    });
    const double with_recheck = milliseconds([&] {
      const auto checker =
          taken(CollisionChecker::make(robot_, spheres_, &semantics_, scene.world, coordinates, rest));
      answer = plan_certain_path(checker, exact, space, from, {to});
    });
    if (answer.refused) ++figures_.refused_once;
    if (answer.ending == PathAnswer::Ending::Exhausted)
      ++figures_.exhausted;
    else if (answer.ending != PathAnswer::Ending::Found)
      ++figures_.ends_collide_by_spheres;
    if (answer.path.empty()) return;
    ++figures_.solved;
    planning_ms_.push_back(spent);
    certain_ms_.push_back(with_recheck);
    if (first_refused(exact, answer.path)) ++figures_.recheck_refuses;
  }

  ProblemFigures figures() {
    figures_.median_ms = quantile(planning_ms_, 0.5);
    figures_.p95_ms = quantile(planning_ms_, 0.95);
    figures_.certain_median_ms = quantile(certain_ms_, 0.5);
    figures_.certain_p95_ms = quantile(certain_ms_, 0.95);
    return figures_;
  }

 private:
  Robot robot_;
  Semantics semantics_;
  Bodies bodies_;
  SphereModel spheres_;
  ProblemFigures figures_;
  std::vector<double> planning_ms_, certain_ms_;
};

}  // namespace

ProblemFigures plan_problems(const ProblemFolders& folders) {
  std::vector<fs::path> scenes;
  for (const auto& each : fs::recursive_directory_iterator(folders.problems))
    if (each.path().filename().string().starts_with("scene") && each.path().extension() == ".yaml")
      scenes.push_back(each.path());
  std::sort(scenes.begin(), scenes.end());
  Problems problems(folders);
  for (const fs::path& scene : scenes)
    problems.plan(scene, scene.parent_path() / ("request" + scene.filename().string().substr(5)));
  return problems.figures();
}

}  // namespace stepwright::bench
