#include "supervisor/motion/recheck/overlap.h"

#include <algorithm>

#include "supervisor/motion/recheck/internal/solid_pairs.h"

namespace stepwright::motion {

namespace {

// A body that is thinner by `by_m` on every side; nothing is left of thin ones but a thousandth.
Body thinner(const Obstacle& obstacle, double by_m) {
  Body body{obstacle.shape, obstacle.mesh};
  const auto less = [by_m](double whole, double sides) {
    return std::max(whole - sides * by_m, 1e-3 * whole);
  };
  body.shape.size_m = {less(body.shape.size_m.x, 2.0), less(body.shape.size_m.y, 2.0),
                       less(body.shape.size_m.z, 2.0)};
  body.shape.radius_m = less(body.shape.radius_m, 1.0);
  body.shape.length_m = less(body.shape.length_m, 2.0);
  return body;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> overlapping(const World& world, double deeper_than_m) {
  std::vector<internal::ExactSolid> solids;
  for (const Obstacle& each : world.obstacles) solids.emplace_back(thinner(each, 0.5 * deeper_than_m));
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < solids.size(); ++a)
    for (std::size_t b = a + 1; b < solids.size(); ++b) {
      const Sphere &one = solids[a].around(), &other = solids[b].around();
      if (world.obstacles[a].name == world.obstacles[b].name ||
          distance(one.centre_m, other.centre_m) > one.radius_m + other.radius_m)
        continue;
      if (meet(solids[a], solids[a].place(), solids[b], solids[b].place())) pairs.emplace_back(a, b);
    }
  return pairs;
}

}  // namespace stepwright::motion
