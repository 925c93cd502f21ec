#pragma once

// What stands around a robot: boxes, cylinders and spheres, each with a name. Values; any thread.
//
//   World world;
//   world.obstacles.push_back(box("table", {{}, {0.6, 0, 0.68}}, {0.8, 1.6, 0.04}));
//   const double free_m = distance_to(world.obstacles[0].shape, point);

#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/robot/robot.h"

namespace stepwright::motion {

struct Obstacle {
  std::string name;
  Shape shape;  // its origin is its place in the frame of the robot's root
};

struct World {
  std::vector<Obstacle> obstacles;
};

namespace code {
inline constexpr const char* kBadWorld = "A0301";  // an obstacle that is no solid, or not finite
}

// Fails with A0301 for meshes, which worlds do not have yet, sizes that are not above zero and what is not
// finite.
[[nodiscard]] result::Result<void> check_world(const World& world);

// Full sides; lengths along z of `place`.
Obstacle box(std::string name, const Transform& place, Vector3 size_m);
Obstacle cylinder(std::string name, const Transform& place, double radius_m, double length_m);
Obstacle sphere(std::string name, Vector3 centre_m, double radius_m);

// From a point to a solid; 0 inside of it. Exact but for rounding. Requires a box, cylinder or sphere.
double distance_to(const Shape& solid, Vector3 point);

}  // namespace stepwright::motion
