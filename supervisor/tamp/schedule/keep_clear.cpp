#include "supervisor/tamp/schedule/keep_clear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "supervisor/motion/path/certain_path.h"

namespace stepwright::tamp::schedule {

namespace {

constexpr double kHeldShrinks_m = 2e-4;
constexpr double kGain_m = 0.004;  // a path that is clearer by less is not worth it

double nearest_along(const ArmCapsules& arm, std::span<const double> from, std::span<const double> to,
                     const std::vector<Capsule>& rest, double step_rad) {
  const int looks = std::max(1, static_cast<int>(std::ceil(motion::joint_distance(from, to) / step_rad)));
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> at(from.begin(), from.end());
  for (int k = 0; k <= looks; ++k) {
    for (std::size_t j = 0; j < at.size(); ++j) at[j] = from[j] + (to[j] - from[j]) * k / looks;
    least = std::min(least, distance_of(capsules_at(arm, at), rest));
  }
  return least;
}

}  // namespace

double nearest_of(const ArmCapsules& arm, const motion::JointPath& path, const std::vector<Capsule>& rest) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < path.size(); ++k)
    least = std::min(least, nearest_along(arm, path[k - 1], path[k], rest, kLook_rad));
  return least;
}

double room_of(const ArmCapsules& arm, const motion::BlendedPath& path, const motion::TimeLaw& law,
               const motion::StopLimits& stop, const std::vector<Capsule>& rest) {
  constexpr double kScan_s = 0.01;
  constexpr double kShares[] = {0.0, 0.44, 0.75, 0.94, 1.0};  // of the braking way, in quarters of its time
  double least = std::numeric_limits<double>::infinity();
  std::array<double, std::size(kShares)> before{};
  std::vector<double> at(path.joints()), slope(path.joints()), braked(path.joints());
  const int scans = static_cast<int>(law.duration() / kScan_s) + 1;
  for (int scan = 0; scan <= scans; ++scan) {
    const motion::Along now = law.at(kScan_s * scan);
    path.at(now.place, at);
    path.at(now.place, slope, 1);
    for (std::size_t k = 0; k < before.size(); ++k) {
      for (std::size_t j = 0; j < at.size(); ++j) {
        const double speed = slope[j] * now.speed;
        const double way = speed * (0.5 * std::abs(speed) / stop.acceleration[j] +
                                    0.5 * stop.acceleration[j] / stop.jerk[j]);
        braked[j] = at[j] + kShares[k] * way;
      }
      const double here = distance_of(capsules_at(arm, braked), rest);
      const double lost = scan == 0 || k == 0 ? 0.0 : std::max(0.0, before[k] - here);
      least = std::min(least, here - 2.0 * lost);
      before[k] = here;
    }
  }
  return least;
}

motion::JointPath kept_clear(const scene::RobotCell& cell, const scene::GeometricState& state,
                             std::size_t arm, const ArmCapsules& capsules, const std::vector<Capsule>& rest,
                             const motion::ExactChecker& exact, const motion::JointPath& path,
                             const ClearOptions& options) {
  const double least = nearest_of(capsules, path, rest);
  if (least >= options.clear_m) return path;
  const double ends = std::min(distance_of(capsules_at(capsules, path.front()), rest),
                               distance_of(capsules_at(capsules, path.back()), rest));
  const scene::Surroundings around = surroundings(cell, state, kHeldShrinks_m);
  const std::vector<int>& coordinates = cell.arms[arm].coordinates;
  const auto spheres = motion::CollisionChecker::make(cell.robot, cell.spheres, &cell.semantics, around.world,
                                                      coordinates, values_of(cell, state), around.held);
  if (!spheres) return path;
  for (const double share : {1.0, 0.7, 0.5}) {
    const double clear_m = std::min(share * options.clear_m, ends - 1e-6);
    if (clear_m < least + kGain_m) break;
    const motion::FreeSpace free{[&](std::span<const double> q) {
                                   return spheres->is_free(q) &&
                                          distance_of(capsules_at(capsules, q), rest) >= clear_m;
                                 },
                                 [&](std::span<const double> from, std::span<const double> to, double step) {
                                   return spheres->motion_is_free(from, to, step) &&
                                          nearest_along(capsules, from, to, rest, 2.0 * kLook_rad) >= clear_m;
                                 }};
    motion::PathOptions how;
    how.seed = options.seed;
    how.most_nodes = 3'000;
    how.most_tries = 3'000;
    motion::CertainOptions certain;
    certain.most_rounds = 2;
    certain.sphere_tries = 3'000;
    certain.body_tries = 0;
    auto found = motion::plan_certain_path(free, exact, motion::joint_space(cell.robot, coordinates),
                                           path.front(), {path.back()}, how, certain);
    if (!found.path.empty() && nearest_of(capsules, found.path, rest) >= least + kGain_m)
      return std::move(found.path);
  }
  return path;
}

}  // namespace stepwright::tamp::schedule
