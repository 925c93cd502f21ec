#include "supervisor/motion/path/plan_path.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {

namespace {

class Tree {
 public:
  explicit Tree(std::size_t columns) : columns_(columns) {}

  std::size_t add(std::span<const double> q, std::size_t parent) {
    numbers_.insert(numbers_.end(), q.begin(), q.end());
    parents_.push_back(parent);
    return parents_.size() - 1;
  }
  std::size_t size() const { return parents_.size(); }
  std::span<const double> node(std::size_t k) const { return {numbers_.data() + k * columns_, columns_}; }

  // Of nodes as near as each other the first.
  std::size_t nearest(std::span<const double> q) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < size(); ++k) {
      const double* const at = numbers_.data() + k * columns_;
      double sum = 0.0;
      for (std::size_t j = 0; j < columns_; ++j) sum += (at[j] - q[j]) * (at[j] - q[j]);
      if (sum < least) least = sum, best = k;
    }
    return best;
  }

  // From the node to its root.
  JointPath way(std::size_t k) const {
    JointPath way;
    for (;; k = parents_[k]) {
      way.emplace_back(node(k).begin(), node(k).end());
      if (parents_[k] == k) return way;
    }
  }

 private:
  std::size_t columns_;
  std::vector<double> numbers_;
  std::vector<std::size_t> parents_;
};

class Planner {
 public:
  Planner(const FreeSpace& free, const JointSpace& space, const PathOptions& options)
      : free_(free), space_(space), options_(options), random_(options.seed) {}

  PathAnswer plan(const Configuration& from, const std::vector<Configuration>& goals) {
    if (!inside(space_, from)) return ended(PathAnswer::Ending::StartCollides);
    // A straight motion has its ends in it.
    for (const Configuration& each : goals)
      if (inside(space_, each) && free(from, each)) return found({from, each});
    if (!free_.is_free(from)) return ended(PathAnswer::Ending::StartCollides);
    Tree start(space_.lower.size()), end(space_.lower.size());
    start.add(from, 0);
    for (const Configuration& each : goals)
      if (inside(space_, each) && free_.is_free(each)) end.add(each, end.size());
    if (end.size() == 0) return ended(PathAnswer::Ending::GoalsCollide);
    Tree* growing = &start;
    Tree* other = &end;
    Configuration target(space_.lower.size());
    for (std::size_t k = 0; k < options_.most_tries && start.size() + end.size() < options_.most_nodes; ++k) {
      for (std::size_t j = 0; j < target.size(); ++j)
        target[j] = random_.between(space_.lower[j], space_.upper[j]);
      if (const auto node = grow(*growing, growing->nearest(target), target)) {
        const Configuration reached(growing->node(*node).begin(), growing->node(*node).end());
        if (const auto met = connect(*other, reached)) {
          answer_.nodes = start.size() + end.size();
          return found(growing == &start ? joined(start.way(*node), end.way(*met))
                                         : joined(start.way(*met), end.way(*node)));
        }
      }
      std::swap(growing, other);
    }
    answer_.nodes = start.size() + end.size();
    return ended(PathAnswer::Ending::Exhausted);
  }

 private:
  bool free(std::span<const double> from, std::span<const double> to) {
    ++answer_.motions;
    return free_.motion_is_free(from, to, options_.step);
  }

  // One step from a node towards the target; nothing where it is blocked.
  std::optional<std::size_t> grow(Tree& tree, std::size_t node, std::span<const double> target) {
    const Configuration from(tree.node(node).begin(), tree.node(node).end());
    Configuration to(target.begin(), target.end());
    const double far = joint_distance(from, to);
    if (far > options_.range)
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + options_.range / far * (to[k] - from[k]);
    if (!free(from, to)) return std::nullopt;
    return tree.add(to, node);
  }

  // Steps towards the target until it is reached; nothing where they are blocked before.
  std::optional<std::size_t> connect(Tree& tree, const Configuration& target) {
    std::size_t node = tree.nearest(target);
    for (;;) {
      const bool last = joint_distance(tree.node(node), target) <= options_.range;
      const auto next = grow(tree, node, target);
      if (!next || last || tree.size() > options_.most_nodes) return next && last ? next : std::nullopt;
      node = *next;
    }
  }

  // Both ways go to their roots, and begin at the same configuration.
  static JointPath joined(JointPath from_start, const JointPath& to_goal) {
    std::reverse(from_start.begin(), from_start.end());
    from_start.insert(from_start.end(), to_goal.begin() + 1, to_goal.end());
    return from_start;
  }

  PathAnswer ended(PathAnswer::Ending ending) {
    answer_.ending = ending;
    return answer_;
  }
  PathAnswer found(JointPath path) {
    answer_.path = std::move(path);
    return ended(PathAnswer::Ending::Found);
  }

  const FreeSpace& free_;
  const JointSpace& space_;
  const PathOptions& options_;
  Random random_;
  PathAnswer answer_;
};

}  // namespace

JointSpace joint_space(const Robot& robot, std::span<const int> coordinates) {
  JointSpace space;
  for (const int each : coordinates) {
    const Coordinate& limits = robot.coordinates[static_cast<std::size_t>(each)];
    space.lower.push_back(std::isinf(limits.lower) ? -std::numbers::pi : limits.lower);
    space.upper.push_back(std::isinf(limits.upper) ? std::numbers::pi : limits.upper);
  }
  return space;
}

bool inside(const JointSpace& space, std::span<const double> q) {
  constexpr double kRounded = 1e-6;
  if (q.size() != space.lower.size()) return false;
  for (std::size_t k = 0; k < q.size(); ++k)
    if (!(q[k] >= space.lower[k] - kRounded && q[k] <= space.upper[k] + kRounded)) return false;
  return true;
}

PathAnswer plan_path(const FreeSpace& free, const JointSpace& space, const Configuration& from,
                     const std::vector<Configuration>& goals, const PathOptions& options) {
  return Planner(free, space, options).plan(from, goals);
}

PathAnswer plan_path(const CollisionChecker& checker, const JointSpace& space, const Configuration& from,
                     const std::vector<Configuration>& goals, const PathOptions& options) {
  return plan_path(by_spheres(checker), space, from, goals, options);
}

}  // namespace stepwright::motion
