#include "supervisor/tamp/mission/retreat.h"

#include <algorithm>
#include <cmath>

#include "supervisor/motion/recheck/exact_checker.h"
#include "supervisor/tamp/predicates/certify.h"
#include "supervisor/tamp/predicates/workspace.h"

namespace stepwright::tamp::mission {
namespace {

constexpr double kSameWay_rad = 0.003;

// The number of the last place up to which the way is free.
std::size_t last_free(const motion::ExactChecker& exact, const motion::JointPath& way) {
  std::size_t last = 0;
  while (last + 1 < way.size() &&
         exact.check_motion(way[last], way[last + 1]).kind == motion::MotionVerdict::Kind::Free)
    ++last;
  return last;
}

// How far the configurations between two are from their straight motion.
double off_way_rad(const motion::JointPath& way, std::size_t from, std::size_t to) {
  double most = 0.0;
  const double whole = motion::joint_distance(way[from], way[to]);
  for (std::size_t k = from + 1; k < to; ++k) {
    const double share = whole > 0.0 ? std::min(1.0, motion::joint_distance(way[from], way[k]) / whole) : 0.0;
    for (std::size_t j = 0; j < way[k].size(); ++j)
      most = std::max(most, std::abs(way[from][j] + share * (way[to][j] - way[from][j]) - way[k][j]));
  }
  return most;
}

// The same way with fewer places: each is a corner of the motion.
motion::JointPath thinned(const motion::JointPath& way) {
  motion::JointPath made{way.front()};
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = at + 1;
    while (next + 1 < way.size() && off_way_rad(way, at, next + 1) <= kSameWay_rad) ++next;
    made.push_back(way[next]);
    at = next;
  }
  return made;
}

}  // namespace

motion::JointPath retreat(const RetreatScene& scene, std::size_t arm, const motion::JointPath& back) {
  if (back.size() < 2) return {};
  predicates::Workspace workspace(scene.there, scene.seed);
  const motion::CollisionChecker& checker = workspace.path_checker(scene.state, static_cast<int>(arm));
  if (checker.is_free(back.front())) return {};
  const scene::RobotCell& known = scene.known;
  const scene::Surroundings around = surroundings(known, scene.state, predicates::kHeldShrunk_m);
  const auto exact = motion::ExactChecker::make(known.robot, known.bodies, &known.semantics, around.world,
                                                known.arms[arm].coordinates, values_of(known, scene.state),
                                                &known.spheres, around.held);
  if (!exact) return {};
  const std::size_t last = last_free(*exact, back);
  std::size_t end = 0;
  while (end < last && !checker.is_free(back[end])) ++end;
  while (end < last && checker.is_free(back[end + 1])) ++end;
  if (end == 0) return {};
  motion::JointPath way(back.begin(), back.begin() + static_cast<std::ptrdiff_t>(end) + 1);
  motion::JointPath lean = thinned(way);
  return last_free(*exact, lean) + 1 == lean.size() ? lean : way;
}

}  // namespace stepwright::tamp::mission
