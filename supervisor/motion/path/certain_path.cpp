#include "supervisor/motion/path/certain_path.h"

#include <utility>

namespace stepwright::motion {

std::optional<MotionVerdict> first_refused(const ExactChecker& exact, const JointPath& path) {
  for (std::size_t k = 1; k < path.size(); ++k) {
    MotionVerdict verdict = exact.check_motion(path[k - 1], path[k]);
    if (verdict.kind != MotionVerdict::Kind::Free) return verdict;
  }
  return std::nullopt;
}

CertainPath plan_certain_path(const CollisionChecker& fast, const ExactChecker& exact,
                              const JointSpace& space, const Configuration& from,
                              const std::vector<Configuration>& goals, PathOptions options,
                              std::size_t most_rounds) {
  CertainPath found;
  while (found.rounds < most_rounds) {
    ++found.rounds;
    PathAnswer answer = plan_path(fast, space, from, goals, options);
    found.ending = answer.ending;
    if (answer.path.empty()) return found;
    JointPath path = shorten(fast, std::move(answer.path), {.seed = options.seed, .step = options.step});
    auto refused = first_refused(exact, path);
    if (!refused) {
      found.path = std::move(path);
      return found;
    }
    found.refused = std::move(refused);
    ++options.seed;
    options.step *= 0.5;
  }
  return found;
}

}  // namespace stepwright::motion
