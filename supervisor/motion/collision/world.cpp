#include "supervisor/motion/collision/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stepwright::motion {

result::Result<void> check_world(const World& world) {
  for (const Obstacle& each : world.obstacles) {
    const Shape& shape = each.shape;
    const auto refuse = [&](const char* what, const char* hint = "") {
      return result::fail(code::kBadWorld, {}, "the obstacle '" + each.name + "' " + what, hint);
    };
    if (shape.kind == ShapeKind::Mesh) return refuse("is a mesh", "make it of boxes, cylinders and spheres");
    double sum = length(shape.origin.position_m);
    for (const double number : shape.origin.rotation.m) sum += number;
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
