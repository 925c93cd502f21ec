#include "tests/bench/motion/scene.h"

#include <fstream>
#include <iterator>

#include "runtime/ground/result/value_or_throw.h"
#include "supervisor/motion/robot/srdf_reader.h"
#include "supervisor/motion/robot/urdf_reader.h"

namespace stepwright::bench {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

MotionScene motion_scene(const std::string& folder) {
  using namespace motion;
  MotionScene scene;
  scene.robot =
      result::value_or_throw(read_urdf(text_of(folder + "/two_arms.urdf"), folder + "/two_arms.urdf"));
  scene.semantics = result::value_or_throw(
      read_srdf(text_of(folder + "/two_arms.srdf"), folder + "/two_arms.srdf", scene.robot));
  scene.bodies = result::value_or_throw(read_bodies(scene.robot, MeshLocator(folder)));
  scene.spheres = cover(scene.bodies);
  scene.coordinates = scene.semantics.group("right_arm")->coordinates;
  scene.rest.resize(scene.robot.coordinates.size());
  for (const NamedState& state : scene.semantics.states)
    if (state.name == "home")
      for (const auto& [coordinate, value] : state.values)
        scene.rest[static_cast<std::size_t>(coordinate)] = value;
  scene.world.obstacles = {box("table", {{}, {0.65, 0, 0.68}}, {0.8, 1.4, 0.04}),
                           box("crate", {from_rpy(0, 0, 0.4), {0.55, 0.02, 0.79}}, {0.2, 0.2, 0.18}),
                           cylinder("post", {from_rpy(0.3, 0.2, 0), {0.65, -0.2, 0.9}}, 0.05, 0.5),
                           sphere("ball", {0.3, 0.5, 1.3}, 0.1)};
  for (int k = 0; k < 8; ++k)
    scene.world.obstacles.push_back(
        cylinder("can", {{}, {0.45 + 0.1 * (k % 4), -0.55 + 0.12 * (k / 4), 0.76}}, 0.035, 0.12));
  return scene;
}

}  // namespace stepwright::bench
