#include "supervisor/motion/path/free_space.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stepwright::motion {

namespace {

bool proved_free(const ExactChecker& exact, std::span<const double> from, std::span<const double> to) {
  return exact.check_motion(from, to).kind == MotionVerdict::Kind::Free;
}

bool places_free(const ExactChecker& exact, std::span<const double> from, std::span<const double> to,
                 double step) {
  double farthest = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) farthest = std::max(farthest, std::abs(to[k] - from[k]));
  const auto steps = static_cast<std::size_t>(std::ceil(farthest / step));
  std::vector<double> q(from.size());
  for (std::size_t place = 0; place <= steps; ++place) {
    const double share = steps == 0 ? 0.0 : static_cast<double>(place) / static_cast<double>(steps);
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = from[k] + share * (to[k] - from[k]);
    if (exact.contact(q)) return false;
  }
  return true;
}

}  // namespace

FreeSpace by_spheres(const CollisionChecker& checker) {
  return {[&checker](std::span<const double> q) { return checker.is_free(q); },
          [&checker](std::span<const double> from, std::span<const double> to, double step) {
            return checker.motion_is_free(from, to, step);
          }};
}

FreeSpace by_spheres(const CollisionChecker& all, const CollisionChecker& lean, const ExactChecker& pairs) {
  return {[&](std::span<const double> q) { return all.is_free(q) || (lean.is_free(q) && !pairs.contact(q)); },
          [&](std::span<const double> from, std::span<const double> to, double step) {
            return all.motion_is_free(from, to, step) ||
                   (lean.motion_is_free(from, to, step) && places_free(pairs, from, to, step));
          }};
}

FreeSpace by_bodies(const ExactChecker& checker) {
  return {[&checker](std::span<const double> q) { return !checker.contact(q); },
          [&checker](std::span<const double> from, std::span<const double> to, double) {
            return proved_free(checker, from, to);
          }};
}

FreeSpace by_spheres_or_bodies(const FreeSpace& fast, const ExactChecker& exact) {
  return {[&](std::span<const double> q) { return fast.is_free(q) || !exact.contact(q); },
          [&](std::span<const double> from, std::span<const double> to, double step) {
            return fast.motion_is_free(from, to, step) || proved_free(exact, from, to);
          }};
}

}  // namespace stepwright::motion
