#include "supervisor/motion/path/shorten.h"

#include <algorithm>
#include <utility>

#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {

namespace {

// A place of a path: between its points `after` and `after` + 1.
struct Place {
  std::size_t after = 0;
  Configuration q;
};

Place place_at(const JointPath& path, double along) {
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const double here = joint_distance(path[k], path[k + 1]);
    if (along > here && k + 2 < path.size()) {
      along -= here;
      continue;
    }
    const double share = here > 0.0 ? std::min(1.0, along / here) : 0.0;
    Place place{k, path[k]};
    for (std::size_t j = 0; j < place.q.size(); ++j) place.q[j] += share * (path[k + 1][j] - path[k][j]);
    return place;
  }
  return {0, path.front()};
}

// Points between which straight motions pass over others.
void drop_points(const FreeSpace& free, JointPath& path, double step) {
  for (std::size_t k = 0; k + 2 < path.size();) {
    std::size_t next = path.size() - 1;
    while (next > k + 1 && !free.motion_is_free(path[k], path[next], step)) --next;
    path.erase(path.begin() + static_cast<std::ptrdiff_t>(k + 1),
               path.begin() + static_cast<std::ptrdiff_t>(next));
    ++k;
  }
}

}  // namespace

JointPath shorten(const FreeSpace& free, JointPath path, const ShortenOptions& options) {
  if (path.size() < 3) return path;
  drop_points(free, path, options.step);
  Random random(options.seed);
  std::size_t in_vain = 0;
  for (std::size_t k = 0; k < options.tries && in_vain < options.most_in_vain && path.size() > 2; ++k) {
    const double whole = joint_length(path);
    double first = random.between(0.0, whole), second = random.between(0.0, whole);
    if (first > second) std::swap(first, second);
    const Place a = place_at(path, first), b = place_at(path, second);
    ++in_vain;
    constexpr double kWorth = 1e-3;
    if (a.after == b.after) continue;
    const double saved = second - first - joint_distance(a.q, b.q);
    if (saved < kWorth * whole || !free.motion_is_free(a.q, b.q, options.step)) continue;
    // What is left of the motions that are cut is tried at other places than before.
    if (!free.motion_is_free(path[a.after], a.q, options.step) ||
        !free.motion_is_free(b.q, path[b.after + 1], options.step))
      continue;
    in_vain = 0;
    JointPath shorter(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(a.after) + 1);
    shorter.push_back(a.q);
    shorter.push_back(b.q);
    shorter.insert(shorter.end(), path.begin() + static_cast<std::ptrdiff_t>(b.after) + 1, path.end());
    path = std::move(shorter);
  }
  drop_points(free, path, options.step);
  return path;
}

JointPath shorten(const CollisionChecker& checker, JointPath path, const ShortenOptions& options) {
  return shorten(by_spheres(checker), std::move(path), options);
}

}  // namespace stepwright::motion
