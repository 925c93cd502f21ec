#pragma once

// Surroundings of a robot: boxes, cylinders, spheres and meshes, each with a name. Values; any thread.
//
//   World world;
//   world.obstacles.push_back(box("table", {{}, {0.6, 0, 0.68}}, {0.8, 1.6, 0.04}));
//   const double free_m = distance_to(world.obstacles[0].shape, point);

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/robot/robot.h"
#include "supervisor/motion/spheres/sphere_model.h"

namespace stepwright::motion {

struct Obstacle {
  std::string name;
  Shape shape;  // its origin is its place in the frame of the robot's root
  // Of a mesh, both in its own frame: its triangles, and spheres that contain it. They are shared by copies.
  std::shared_ptr<const TriangleMesh> mesh = nullptr;
  std::shared_ptr<const std::vector<Sphere>> spheres = nullptr;
};

struct World {
  std::vector<Obstacle> obstacles;
  // May touch each other and are not checked: a link or carried thing (attached_body.h), and an obstacle.
  std::vector<std::pair<std::string, std::string>> allowed = {};

  // In either order. Obstacles of one name are allowed together.
  bool may_touch(std::string_view link, std::string_view obstacle) const;
};

namespace code {
inline constexpr const char* kBadWorld = "A0301";  // an obstacle that is no solid, or not finite
}

// Fails with A0301 for sizes that are not above zero, meshes without triangles or spheres, and what is not
// finite.
[[nodiscard]] result::Result<void> check_world(const World& world);

// Full sides; lengths along z of `place`.
Obstacle box(std::string name, const Transform& place, Vector3 size_m);
Obstacle cylinder(std::string name, const Transform& place, double radius_m, double length_m);
Obstacle sphere(std::string name, Vector3 centre_m, double radius_m);
// `triangles` in the frame of `place`. The spheres that stand for it follow it as closely as `cover` says.
inline constexpr CoverOptions kObstacleCover{.protrusion_m = 0.01, .most_per_body = 256};
Obstacle mesh(std::string name, const Transform& place, std::shared_ptr<const TriangleMesh> triangles,
              const CoverOptions& cover = kObstacleCover);

// From a point to a solid; 0 inside of it. Exact but for rounding. Requires a box, cylinder or sphere.
double distance_to(const Shape& solid, Vector3 point);
// The same; of a mesh not more than that: to the spheres around it.
double distance_below(const Obstacle& obstacle, Vector3 point);

}  // namespace stepwright::motion
