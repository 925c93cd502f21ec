#include "supervisor/tamp/predicates/samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "supervisor/geometry/radical_inverse.h"

namespace stepwright::tamp::predicates {

using geometry::radical_inverse;

double grasp_sample(std::size_t k) {
  return 2.0 * std::numbers::pi * radical_inverse(k, 2);
}

scene::Pose place_on(const scene::Surface& surface, double along_m, double across_m, double angle_rad) {
  const double c = std::cos(surface.middle.angle_rad), s = std::sin(surface.middle.angle_rad);
  return {surface.middle.x_m + c * along_m - s * across_m, surface.middle.y_m + s * along_m + c * across_m,
          surface.middle.z_m, angle_rad};
}

scene::Pose stack_sample(const scene::RobotCell& cell, int carrier, int thing,
                         const scene::GeometricState& state, std::size_t k) {
  const scene::Thing& upper = cell.things[static_cast<std::size_t>(thing)];
  const double angle_rad =
      upper.turns ? 2.0 * std::numbers::pi * radical_inverse(k, 5) : upper.start.angle_rad;
  return top_of(cell, carrier, state.things[static_cast<std::size_t>(carrier)].pose, angle_rad);
}

scene::Pose place_sample(const scene::Surface& surface, const scene::Thing& thing, std::size_t k) {
  const double around_m = radius_around(thing.form);
  const double free_x = std::max(0.0, surface.size_x_m - 2.0 * around_m),
               free_y = std::max(0.0, surface.size_y_m - 2.0 * around_m);
  const double angle_rad =
      thing.turns ? 2.0 * std::numbers::pi * radical_inverse(k, 5) : thing.start.angle_rad;
  return place_on(surface, (radical_inverse(k, 2) - 0.5) * free_x, (radical_inverse(k, 3) - 0.5) * free_y,
                  angle_rad);
}

}  // namespace stepwright::tamp::predicates
