#include "plant_models/body2d/conveying.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace stepwright::body2d {
namespace {

constexpr double kGravity = 9.81;  // m/s2
constexpr std::array kGrid = {-1.0 / 3.0, 0.0, 1.0 / 3.0};
constexpr double kShare = 1.0 / 9.0;

std::size_t surface_at(Vec2 point, std::span<const Surface> surfaces) {
  std::size_t i = 0;
  while (i < surfaces.size() && !surfaces[i].area.contains(point)) ++i;
  return i;
}

}  // namespace

void convey(World& world, BodyId box, Rectangle shape, std::span<const Surface> surfaces, double ground_grip,
            std::span<double> pulled_n) {
  assert(pulled_n.size() == surfaces.size());
  const Pose pose = world.pose(box);
  const Motion motion = world.motion(box);
  const double borne_kg = world.mass_kg(box) * kShare;
  Vec2 momentum;
  double angular = 0.0;
  for (const double along : kGrid) {
    for (const double across : kGrid) {
      const Vec2 point = to_plane(pose, {along * shape.size.x, across * shape.size.y});
      const Vec2 arm = point - pose.position;
      const Vec2 moving = motion.velocity + Vec2{-motion.spin * arm.y, motion.spin * arm.x};
      const std::size_t below = surface_at(point, surfaces);
      const bool ground = below == surfaces.size();
      const Vec2 carried = ground ? Vec2{} : surfaces[below].velocity;
      const double grip = ground ? ground_grip : surfaces[below].grip;
      Vec2 j = borne_kg * (carried - moving);
      const double limit = grip * borne_kg * kGravity * world.step_s();
      const double size = length(j);
      if (size > limit) j = (limit / size) * j;
      momentum = momentum + j;
      angular += cross(arm, j);
      if (ground) continue;
      const double speed = length(carried);
      if (speed > 0.0) pulled_n[below] += (j.x * carried.x + j.y * carried.y) / (speed * world.step_s());
    }
  }
  world.push(box, momentum, angular);
}

}  // namespace stepwright::body2d
