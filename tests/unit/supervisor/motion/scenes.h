#pragma once

// Robots with spheres, groups and a world for the tests of collisions.

#include <vector>

#include "supervisor/motion/collision/collision_checker.h"
#include "supervisor/motion/spatial/random.h"
#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion::tests {

// A table, a box on it, a post and a ball: what the arms can reach, and what they cannot.
inline World table_with_things() {
  World world;
  world.obstacles = {box("table", {{}, {0.65, 0, 0.68}}, {0.8, 1.4, 0.04}),
                     box("crate", {from_rpy(0, 0, 0.4), {0.55, 0.02, 0.79}}, {0.2, 0.2, 0.18}),
                     cylinder("post", {from_rpy(0.3, 0.2, 0), {0.65, -0.2, 0.9}}, 0.05, 0.5),
                     cylinder("can", {{}, {0.62, 0.25, 0.76}}, 0.035, 0.12),
                     sphere("ball", {0.3, 0.5, 1.3}, 0.1),
                     box("far", {{}, {9, 0, 0}}, {1, 1, 1})};
  return world;
}

struct Scene {
  Robot robot;
  Semantics semantics;
  Bodies bodies;
  SphereModel spheres;
  std::vector<int> coordinates;
  std::vector<double> rest;
  World world;

  CollisionChecker checker() const {
    auto made = CollisionChecker::make(robot, spheres, &semantics, world, coordinates, rest);
    EXPECT_TRUE(made) << to_string(made.error());
    return std::move(*made);
  }
};

// The own robot with the coordinates of a group; the others at home, hands open.
inline Scene own_scene(const std::string& group) {
  Scene scene;
  scene.robot = two_arms();
  scene.semantics = two_arms_semantics(scene.robot);
  scene.bodies = *read_bodies(scene.robot, MeshLocator(own_folder()));
  scene.spheres = cover(scene.bodies);
  scene.coordinates = scene.semantics.group(group)->coordinates;
  scene.rest.resize(scene.robot.coordinates.size());
  for (const NamedState& state : scene.semantics.states)
    if (state.name == "home" || state.name == "open")
      for (const auto& [coordinate, value] : state.values)
        scene.rest[static_cast<std::size_t>(coordinate)] = value;
  scene.world = table_with_things();
  return scene;
}

inline std::vector<double> draw_rows(const Scene& scene, std::size_t count, Random& random) {
  std::vector<double> rows;
  for (std::size_t k = 0; k < count; ++k)
    for (const int each : scene.coordinates) {
      const Coordinate& limits = scene.robot.coordinates[static_cast<std::size_t>(each)];
      rows.push_back(random.between(std::max(limits.lower, -3.2), std::min(limits.upper, 3.2)));
    }
  return rows;
}

}  // namespace stepwright::motion::tests
