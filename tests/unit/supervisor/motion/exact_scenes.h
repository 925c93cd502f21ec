#pragma once

// Scenes with exact checkers, and the Panda with its meshes where the data of others is.

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/recheck/exact_checker.h"
#include "tests/unit/supervisor/motion/scenes.h"

namespace stepwright::motion::tests {

inline ExactChecker exact_of(const Scene& scene, bool with_spheres = false) {
  auto made = ExactChecker::make(scene.robot, scene.bodies, &scene.semantics, scene.world, scene.coordinates,
                                 scene.rest, with_spheres ? &scene.spheres : nullptr);
  EXPECT_TRUE(made) << to_string(made.error());
  return std::move(*made);
}

inline std::vector<double> home_of(const Scene& scene) {
  std::vector<double> home;
  for (const int each : scene.coordinates) home.push_back(scene.rest[static_cast<std::size_t>(each)]);
  return home;
}

inline std::optional<Scene> panda_scene() {
  const auto urdf = data_of_others("arms/panda/panda.urdf");
  if (!urdf) return std::nullopt;
  Scene scene;
  scene.robot = robot_of(*urdf);
  scene.semantics = semantics_of(urdf->parent_path() / "panda.srdf", scene.robot);
  scene.bodies = *read_bodies(scene.robot, MeshLocator(urdf->parent_path()));
  scene.spheres = cover(scene.bodies);
  scene.coordinates = scene.semantics.group("panda_arm")->coordinates;
  scene.rest.assign(scene.robot.coordinates.size(), 0.0);
  scene.world.obstacles = {box("shelf", {{}, {0.6, 0, 0.3}}, {0.3, 0.8, 0.03}),
                           cylinder("post", {{}, {0.3, 0.4, 0.4}}, 0.04, 0.8),
                           sphere("ball", {-0.3, -0.3, 0.7}, 0.1)};
  return scene;
}

}  // namespace stepwright::motion::tests
