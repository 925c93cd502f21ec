#include "tests/bench/arm/problem_sets.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <utility>

#include "runtime/ground/result/value_or_throw.h"
#include "supervisor/motion/problem/arm_checkers.h"
#include "supervisor/motion/recheck/exact_checker.h"
#include "supervisor/motion/scene/scene_file.h"
#include "supervisor/motion/spatial/random.h"

namespace stepwright::bench {

namespace {

namespace fs = std::filesystem;
using namespace motion;

// An archive unpacked into a folder that goes away.
class Unpacked {
 public:
  explicit Unpacked(const fs::path& archive)
      : folder_(fs::temp_directory_path() / ("stepwright_bench_arm_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    const std::string command = "tar -xjf '" + archive.string() + "' -C '" + folder_.string() + "'";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("cannot unpack " + archive.string());
  }
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;
  ~Unpacked() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

// Scenes of each scenario, which is a folder, in order.
std::vector<fs::path> scenes_in(const fs::path& folder, std::size_t per_scenario) {
  std::map<std::string, std::vector<fs::path>> scenarios;
  for (const auto& each : fs::recursive_directory_iterator(folder))
    if (each.path().filename().string().starts_with("scene") && each.path().extension() == ".yaml")
      scenarios[each.path().parent_path().filename().string()].push_back(each.path());
  std::vector<fs::path> all;
  for (auto& [name, scenes] : scenarios) {
    std::sort(scenes.begin(), scenes.end());
    scenes.resize(std::min(scenes.size(), per_scenario));
    all.insert(all.end(), scenes.begin(), scenes.end());
  }
  return all;
}

}  // namespace

std::optional<fs::path> arms_folder() {
  const char* given = std::getenv("STEPWRIGHT_DATA");
  const fs::path folder =
      (given ? fs::path(given) : fs::path(STEPWRIGHT_SOURCE_DIR) / "../shared/data") / "arms";
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return std::nullopt;
  return folder;
}

ProblemSet problems_of_others(const fs::path& arms, const std::string& robot, std::size_t per_scenario,
                              double protrusion_m) {
  const fs::path folder = arms / robot;
  ArmFiles files{.urdf = folder / (robot + ".urdf"), .srdf = folder / (robot + ".srdf")};
  files.cover.protrusion_m = protrusion_m;
  if (robot == "ur5") {
    // The meshes of its gripper are not there; VAMP's description of it by spheres stands for them.
    files.instead = folder / "ur5_spherized.urdf";
    files.packages.emplace_back("package://meshes/ur5", (folder / "meshes").string());
  }
  ProblemSet set;
  set.name = robot;
  set.model = result::value_or_throw(load_arm(files));
  const Unpacked unpacked(folder / "problems.tar.bz2");
  for (const fs::path& scene : scenes_in(unpacked.folder(), per_scenario)) {
    const fs::path request = scene.parent_path() / ("request" + scene.filename().string().substr(5));
    set.problems.push_back(result::value_or_throw(load_problem(set.model, scene, request)));
    set.names.push_back(scene.parent_path().filename().string() + "/" + scene.stem().string().substr(5));
  }
  set.pairs = pairs_of(set.model, set.problems.at(0));
  return set;
}

ProblemSet problems_of_our_own(std::size_t count, double protrusion_m) {
  const fs::path folder = fs::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells/robot_cell";
  ArmFiles files{.urdf = folder / "two_arms.urdf", .srdf = folder / "two_arms.srdf"};
  files.cover.protrusion_m = protrusion_m;
  ProblemSet set;
  set.name = "own";
  set.model = result::value_or_throw(load_arm(files));
  const ArmProblem first =
      result::value_or_throw(load_problem(set.model, folder / "table.toml", folder / "swing.yaml"));
  const auto exact = result::value_or_throw(ExactChecker::make(
      set.model.robot, set.model.bodies, first.known_pairs(), first.world, first.coordinates, first.rest));
  const JointSpace space = joint_space(set.model.robot, first.coordinates);
  Random random(1);
  while (set.problems.size() < count) {
    ArmProblem problem = first;
    for (std::size_t k = 0; k < problem.to.size(); ++k)
      problem.to[k] = random.between(space.lower[k], space.upper[k]);
    if (exact.contact(problem.to)) continue;
    set.names.push_back("drawn/" + std::to_string(set.problems.size() + 1));
    set.problems.push_back(std::move(problem));
  }
  set.pairs = pairs_of(set.model, set.problems.at(0));
  return set;
}

}  // namespace stepwright::bench
