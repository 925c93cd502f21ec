#include "supervisor/motion/path/way_out.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {

namespace {

class ExactTree {
 public:
  ExactTree(const FreeSpace& fast, const ExactChecker& exact, const JointSpace& space,
            const Configuration& from, const WayOutOptions& options)
      : fast_(fast), exact_(exact), space_(space), options_(options), random_(options.seed) {
    nodes_.push_back(from);
    parents_.push_back(0);
  }

  JointPath grow() {
    for (std::size_t round = 0; round < options_.rounds; ++round) {
      const double share = static_cast<double>(round) / static_cast<double>(options_.rounds);
      const double radius = options_.nearest * std::pow(options_.farthest / options_.nearest, share);
      if (const auto out = try_round(radius)) return way_to(*out);
    }
    return {};
  }

 private:
  Configuration place(double radius) {
    Configuration q = nodes_.front();
    for (std::size_t k = 0; k < q.size(); ++k)
      q[k] = std::clamp(q[k] + random_.between(-radius, radius), space_.lower[k], space_.upper[k]);
    return q;
  }

  std::size_t nearest(const Configuration& q) const {
    const auto closer = [&](const Configuration& a, const Configuration& b) {
      return joint_distance(a, q) < joint_distance(b, q);
    };
    return static_cast<std::size_t>(std::min_element(nodes_.begin(), nodes_.end(), closer) - nodes_.begin());
  }

  bool add(const Configuration& q) {
    const std::size_t node = nearest(q);
    if (exact_.check_motion(nodes_[node], q).kind != MotionVerdict::Kind::Free) return false;
    nodes_.push_back(q);
    parents_.push_back(node);
    return true;
  }

  // The node that is out. The nearest places that are free by spheres are tried; then one that is not makes
  // the tree larger.
  std::optional<std::size_t> try_round(double radius) {
    std::vector<Configuration> places;
    for (std::size_t k = 0; k < options_.places; ++k) places.push_back(place(radius));
    std::vector<std::pair<double, std::size_t>> out;
    std::size_t blocked = places.size();
    for (std::size_t k = 0; k < places.size(); ++k)
      if (fast_.is_free(places[k]))
        out.emplace_back(joint_distance(places[k], nodes_[nearest(places[k])]), k);
      else if (blocked == places.size())
        blocked = k;
    std::sort(out.begin(), out.end());
    for (std::size_t k = 0; k < std::min(out.size(), options_.most_exact); ++k)
      if (add(places[out[k].second])) return nodes_.size() - 1;
    if (blocked < places.size()) (void)add(places[blocked]);
    return std::nullopt;
  }

  JointPath way_to(std::size_t node) const {
    JointPath way;
    for (;; node = parents_[node]) {
      way.push_back(nodes_[node]);
      if (node == 0) break;
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  const FreeSpace& fast_;
  const ExactChecker& exact_;
  const JointSpace& space_;
  const WayOutOptions& options_;
  Random random_;
  std::vector<Configuration> nodes_;
  std::vector<std::size_t> parents_;
};

}  // namespace

JointPath way_out(const FreeSpace& fast, const ExactChecker& exact, const JointSpace& space,
                  const Configuration& from, const WayOutOptions& options) {
  if (fast.is_free(from)) return {from};
  if (exact.contact(from)) return {};
  return ExactTree(fast, exact, space, from, options).grow();
}

}  // namespace stepwright::motion
