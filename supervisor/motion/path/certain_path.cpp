#include "supervisor/motion/path/certain_path.h"

#include <algorithm>
#include <utility>

#include "supervisor/motion/path/way_out.h"

namespace stepwright::motion {

namespace {

class CertainPlanner {
 public:
  CertainPlanner(const FreeSpace& fast, const ExactChecker& exact, const JointSpace& space,
                 PathOptions options, const CertainOptions& certain)
      : fast_(&fast), exact_(exact), space_(space), options_(options), certain_(certain) {}

  CertainPath plan(const Configuration& from, const std::vector<Configuration>& goals) {
    if (!ends_are_free(from, goals)) return std::move(found_);
    while (found_.rounds < certain_.most_rounds) {
      ++found_.rounds;
      JointPath path;
      if (found_.means != CertainPath::Means::ByBodies) path = by_spheres_and_ways(from);
      if (path.empty()) path = by_bodies_where_needed(from);
      if (path.empty()) break;
      auto refused = first_refused(exact_, path);
      if (!refused) {
        found_.path = std::move(path);
        break;
      }
      found_.refused = std::move(refused);
      ++found_.thrown_away;
      if (certain_.careful != nullptr && fast_ != certain_.careful) {
        fast_ = certain_.careful;
        has_ways_ = false;  // ends that spheres allow may be others now
        ways_.clear();
      }
      ++options_.seed;
      options_.step *= 0.5;
    }
    return std::move(found_);
  }

 private:
  // Fills goals_, the ways from the start and to the goals that spheres refuse.
  bool ends_are_free(const Configuration& from, const std::vector<Configuration>& goals) {
    found_.ending = PathAnswer::Ending::StartCollides;
    if (!inside(space_, from)) return false;
    if (!fast_->is_free(from) && (found_.contact = exact_.contact(from))) return false;
    found_.ending = PathAnswer::Ending::GoalsCollide;
    for (const Configuration& each : goals) {
      if (!inside(space_, each)) continue;
      if (!fast_->is_free(each)) {
        if (auto met = exact_.contact(each)) {
          if (!found_.contact) found_.contact = std::move(met);
          continue;
        }
      }
      goals_.push_back(each);
    }
    if (goals_.empty()) return false;
    found_.contact.reset();
    found_.ending = PathAnswer::Ending::Exhausted;
    return true;
  }

  void find_ways(const Configuration& from) {
    if (has_ways_) return;
    has_ways_ = true;
    out_ = way_out(*fast_, exact_, space_, from, {.seed = options_.seed});
    constexpr std::size_t kMostWays = 8;  // an end for each; none is found in many tries
    for (std::size_t k = 0; k < std::min(goals_.size(), kMostWays); ++k)
      ways_.push_back(way_out(*fast_, exact_, space_, goals_[k], {.seed = options_.seed}));
  }

  // Empty: spheres leave no way.
  JointPath by_spheres_and_ways(const Configuration& from) {
    find_ways(from);
    std::vector<Configuration> ends;
    for (const JointPath& each : ways_)
      if (!each.empty()) ends.push_back(each.back());
    if (out_.empty() || ends.empty()) return {};
    PathOptions options = options_;
    options.most_tries = std::min(options.most_tries, certain_.sphere_tries);
    PathAnswer answer = plan_path(*fast_, space_, out_.back(), ends, options);
    found_.ending = answer.ending;
    if (answer.path.empty()) return {};
    const Configuration reached = answer.path.back();
    JointPath path = shorten(*fast_, std::move(answer.path), {.seed = options_.seed, .step = options_.step});
    const auto way = std::find_if(ways_.begin(), ways_.end(), [&](const JointPath& each) {
      return !each.empty() && each.back() == reached;
    });
    if (out_.size() == 1 && way->size() == 1) return path;
    found_.means = CertainPath::Means::WaysOut;
    path.insert(path.begin(), out_.begin(), out_.end() - 1);
    path.insert(path.end(), way->rbegin() + 1, way->rend());
    return path;
  }

  JointPath by_bodies_where_needed(const Configuration& from) {
    found_.means = CertainPath::Means::ByBodies;
    const FreeSpace free = by_spheres_or_bodies(*fast_, exact_);
    PathOptions options = options_;
    options.most_tries = std::min(options.most_tries, certain_.body_tries);
    PathAnswer answer = plan_path(free, space_, from, goals_, options);
    found_.ending = answer.ending;
    constexpr std::size_t kTries = 40;  // each may take as long as a proof
    return answer.path.empty() ? JointPath{}
                               : shorten(free, std::move(answer.path),
                                         {.seed = options_.seed, .step = options_.step, .tries = kTries});
  }

  const FreeSpace* fast_;
  const ExactChecker& exact_;
  const JointSpace& space_;
  PathOptions options_;
  const CertainOptions& certain_;
  CertainPath found_;
  std::vector<Configuration> goals_;  // that the bodies allow
  bool has_ways_ = false;
  JointPath out_;                // of the start
  std::vector<JointPath> ways_;  // of the goals
};

}  // namespace

std::optional<MotionVerdict> first_refused(const ExactChecker& exact, const JointPath& path) {
  for (std::size_t k = 1; k < path.size(); ++k) {
    MotionVerdict verdict = exact.check_motion(path[k - 1], path[k]);
    if (verdict.kind != MotionVerdict::Kind::Free) return verdict;
  }
  return std::nullopt;
}

CertainPath plan_certain_path(const FreeSpace& fast, const ExactChecker& exact, const JointSpace& space,
                              const Configuration& from, const std::vector<Configuration>& goals,
                              PathOptions options, const CertainOptions& certain) {
  return CertainPlanner(fast, exact, space, options, certain).plan(from, goals);
}

CertainPath plan_certain_path(const CollisionChecker& fast, const ExactChecker& exact,
                              const JointSpace& space, const Configuration& from,
                              const std::vector<Configuration>& goals, PathOptions options,
                              const CertainOptions& certain) {
  return plan_certain_path(by_spheres(fast), exact, space, from, goals, options, certain);
}

}  // namespace stepwright::motion
