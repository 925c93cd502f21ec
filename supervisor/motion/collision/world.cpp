#include "supervisor/motion/collision/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stepwright::motion {

result::Result<void> check_world(const World& world) {
  for (const Obstacle& each : world.obstacles) {
    const Shape& shape = each.shape;
    const auto refuse = [&](const char* what) {
      return result::fail(code::kBadWorld, {}, "the obstacle '" + each.name + "' " + what);
    };
    double sum = length(shape.origin.position_m);
    for (const double number : shape.origin.rotation.m) sum += number;
    if (shape.kind == ShapeKind::Mesh) {
      if (!each.mesh || each.mesh->triangles.empty() || !each.spheres || each.spheres->empty())
        return refuse("is a mesh without triangles or spheres");
      if (!std::isfinite(sum)) return refuse("has a number that is not finite");
      continue;
    }
    const double least = shape.kind == ShapeKind::Box
                             ? std::min({shape.size_m.x, shape.size_m.y, shape.size_m.z})
                         : shape.kind == ShapeKind::Cylinder ? std::min(shape.radius_m, shape.length_m)
                                                             : shape.radius_m;
    if (!std::isfinite(sum) || !std::isfinite(length(shape.size_m) + shape.radius_m + shape.length_m))
      return refuse("has a number that is not finite");
    if (!(least > 0.0)) return refuse("has no size");
  }
  return {};
}

Obstacle box(std::string name, const Transform& place, Vector3 size_m) {
  Shape shape;
  shape.kind = ShapeKind::Box;
  shape.origin = place;
  shape.size_m = size_m;
  return {std::move(name), std::move(shape)};
}

Obstacle cylinder(std::string name, const Transform& place, double radius_m, double length_m) {
  Shape shape;
  shape.kind = ShapeKind::Cylinder;
  shape.origin = place;
  shape.radius_m = radius_m;
  shape.length_m = length_m;
  return {std::move(name), std::move(shape)};
}

Obstacle sphere(std::string name, Vector3 centre_m, double radius_m) {
  Shape shape;
  shape.kind = ShapeKind::Sphere;
  shape.origin.position_m = centre_m;
  shape.radius_m = radius_m;
  return {std::move(name), std::move(shape)};
}

Obstacle mesh(std::string name, const Transform& place, std::shared_ptr<const TriangleMesh> triangles,
              const CoverOptions& cover) {
  Shape shape;
  shape.kind = ShapeKind::Mesh;
  shape.origin = place;
  auto spheres = std::make_shared<const std::vector<Sphere>>(triangles ? motion::cover(*triangles, cover)
                                                                       : std::vector<Sphere>{});
  return {std::move(name), std::move(shape), std::move(triangles), std::move(spheres)};
}

double distance_below(const Obstacle& obstacle, Vector3 point) {
  if (obstacle.shape.kind != ShapeKind::Mesh) return distance_to(obstacle.shape, point);
  const Vector3 p = inverse(obstacle.shape.origin) * point;
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& each : *obstacle.spheres)
    least = std::min(least, distance(each.centre_m, p) - each.radius_m);
  return std::max(0.0, least);
}

bool World::may_touch(std::string_view link, std::string_view obstacle) const {
  return std::any_of(allowed.begin(), allowed.end(), [&](const auto& pair) {
    return (pair.first == link && pair.second == obstacle) || (pair.first == obstacle && pair.second == link);
  });
}

double distance_to(const Shape& solid, Vector3 point) {
  const Vector3 p = inverse(solid.origin) * point;
  const auto outside = [](double value, double half) { return std::max(0.0, std::abs(value) - half); };
  switch (solid.kind) {
    case ShapeKind::Sphere:
      return std::max(0.0, length(p) - solid.radius_m);
    case ShapeKind::Cylinder:
      return std::hypot(std::max(0.0, std::hypot(p.x, p.y) - solid.radius_m),
                        outside(p.z, 0.5 * solid.length_m));
    default:
      return length({outside(p.x, 0.5 * solid.size_m.x), outside(p.y, 0.5 * solid.size_m.y),
                     outside(p.z, 0.5 * solid.size_m.z)});
  }
}

}  // namespace stepwright::motion
