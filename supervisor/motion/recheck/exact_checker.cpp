#include "supervisor/motion/recheck/exact_checker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/recheck/internal/solid_pairs.h"

namespace stepwright::motion {

namespace {

using internal::ExactSolid;

// A body of a link, or an obstacle (link -1).
struct Placed {
  ExactSolid solid;
  int link = -1;
  std::string name;
  Obstacle obstacle = {};
};

// A joint that moves two bodies of a pair against each other, and by how much at most per unit of its
// coordinate.
struct Lever {
  std::size_t column = 0;
  double most_m = 0.0;
};

struct CheckedPair {
  std::size_t a = 0, b = 0;  // placed
  std::vector<Lever> levers;
};

}  // namespace

class ExactChecker::Scene {
 public:
  // The robot as it was given, its bodies as solids: what scenes of the same robot share.
  struct Base {
    Robot robot;
    Bodies bodies;
    SphereModel spheres;
    bool has_spheres = false;
    std::optional<Semantics> semantics;
    std::vector<int> coordinates;
    std::vector<ExactSolid> solids;  // of all bodies, link after link
  };

  static std::shared_ptr<const Base> base(const Robot& robot, const Bodies& bodies,
                                          const Semantics* semantics, std::span<const int> coordinates,
                                          const SphereModel* spheres) {
    Base made{robot,
              bodies,
              spheres ? *spheres : SphereModel{},
              spheres != nullptr,
              std::nullopt,
              {coordinates.begin(), coordinates.end()},
              {}};
    if (semantics) made.semantics = *semantics;
    for (const std::vector<Body>& link : bodies)
      for (const Body& each : link) made.solids.emplace_back(each);
    return std::make_shared<const Base>(std::move(made));
  }

  Scene(std::shared_ptr<const Base> base, const World& world, std::span<const double> rest,
        const std::vector<AttachedBody>& attached)
      : base_(std::move(base)),
        all_(carrying(base_->robot, base_->has_spheres ? &base_->spheres : nullptr, &base_->bodies,
                      base_->semantics ? &*base_->semantics : nullptr, attached)),
        robot_(all_.robot),
        kinematics_(robot_),
        coordinates_(base_->coordinates),
        rest_(rest.begin(), rest.end()),
        spheres_(all_.spheres) {
    std::size_t known = 0;
    for (std::size_t link = 0; link < all_.bodies.size(); ++link)
      for (const Body& each : all_.bodies[link]) {
        placed_.push_back({known < base_->solids.size() ? base_->solids[known] : ExactSolid(each),
                           static_cast<int>(link), robot_.links[link].name});
        ++known;
      }
    const std::size_t of_robot = placed_.size();
    for (const LinkSpheres& link : spheres_.links)
      first_sphere_.push_back(first_sphere_.back() + link.spheres.size());
    for (const Obstacle& each : world.obstacles)
      placed_.push_back({ExactSolid({each.shape, each.mesh}), -1, each.name, each});
    for (std::size_t a = 0; a < of_robot; ++a)
      for (std::size_t b = a + 1; b < placed_.size(); ++b)
        if (placed_[b].link >= 0 || !world.may_touch(placed_[a].name, placed_[b].name)) add_pair(a, b);
  }
  Scene(const Scene&) = delete;  // members look at each other
  Scene& operator=(const Scene&) = delete;

  const std::shared_ptr<const Base>& base() const { return base_; }
  std::size_t columns() const { return coordinates_.size(); }

  std::optional<Contact> contact(std::span<const double> configuration) const {
    const Placement placement = place(configuration);
    for (const CheckedPair& pair : pairs_) {
      if (gap_around(pair, placement) > 0.0 || gap_of_spheres(pair, placement, 0.0) > 0.0) continue;
      if (meet(placed_[pair.a].solid, at(pair.a, placement), placed_[pair.b].solid, at(pair.b, placement)))
        return named(pair);
    }
    return std::nullopt;
  }

  MotionVerdict check_motion(std::span<const double> from, std::span<const double> to) const {
    std::vector<std::size_t> all(pairs_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    // Ends first: they are what is wrong most often, and parts are judged by their middles.
    for (const double share : {0.0, 1.0})
      if (const auto met = contact(between(from, to, share)))
        return {MotionVerdict::Kind::Collides, share, *met};
    return check_part(from, to, 0.0, 1.0, all);
  }

 private:
  // Where links are, the centres of their spheres, link after link, and those of the spheres around bodies.
  struct Placement {
    std::vector<Transform> links;
    std::vector<Vector3> centres;
    std::vector<Vector3> around;
  };

  // Whether a joint is above a link.
  bool carries(std::size_t joint, int link) const {
    return link >= 0 && robot_.hangs_below(link, Robot::link_below(static_cast<int>(joint)));
  }

  // How far from a joint's place any point of a body can be, whatever the joints below do.
  double reach(std::size_t joint, const Placed& body) const {
    double far_m = length(body.solid.around().centre_m) + body.solid.around().radius_m;
    for (int link = body.link; link != Robot::link_below(static_cast<int>(joint));
         link = robot_.parent_link(link)) {
      const Joint& between = robot_.joints[static_cast<std::size_t>(Robot::joint_above(link))];
      far_m += length(between.origin.position_m);
      if (between.kind == JointKind::Prismatic && between.coordinate >= 0) far_m += travel(between);
    }
    return far_m;
  }

  double travel(const Joint& joint) const {
    const Coordinate& limits = robot_.coordinates[static_cast<std::size_t>(joint.coordinate)];
    return std::abs(joint.multiplier) * std::max(std::abs(limits.lower), std::abs(limits.upper)) +
           std::abs(joint.offset);
  }

  void add_pair(std::size_t a, std::size_t b) {
    const Placed &of_a = placed_[a], &of_b = placed_[b];
    if (of_a.link == of_b.link) return;
    CheckedPair pair{a, b, {}};
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const Joint& joint = robot_.joints[j];
      const auto column = std::find(coordinates_.begin(), coordinates_.end(), joint.coordinate);
      if (joint.coordinate < 0 || column == coordinates_.end()) continue;
      const bool moves_a = carries(j, of_a.link), moves_b = carries(j, of_b.link);
      if (moves_a == moves_b) continue;
      const double far_m = joint.kind == JointKind::Prismatic ? 1.0 : reach(j, moves_a ? of_a : of_b);
      pair.levers.push_back(
          {static_cast<std::size_t>(column - coordinates_.begin()), std::abs(joint.multiplier) * far_m});
    }
    if (pair.levers.empty()) return;  // they do not move against each other
    if (of_b.link >= 0 && all_.semantics.is_disabled(of_a.link, of_b.link)) return;
    pairs_.push_back(std::move(pair));
  }

  Placement place(std::span<const double> configuration) const {
    std::vector<double> all = rest_;
    for (std::size_t k = 0; k < coordinates_.size(); ++k)
      all[static_cast<std::size_t>(coordinates_[k])] = configuration[k];
    Placement placed{std::vector<Transform>(robot_.links.size()), {}, {}};
    kinematics_.place(all, placed.links);
    placed.centres.reserve(first_sphere_.back());
    for (std::size_t link = 0; link < spheres_.links.size(); ++link)
      for (const Sphere& each : spheres_.links[link].spheres)
        placed.centres.push_back(placed.links[link] * each.centre_m);
    placed.around.reserve(placed_.size());
    for (const Placed& each : placed_) {
      const Vector3& centre = each.solid.around().centre_m;
      placed.around.push_back(each.link < 0 ? centre
                                            : placed.links[static_cast<std::size_t>(each.link)] * centre);
    }
    return placed;
  }

  Transform at(std::size_t which, const Placement& placement) const {
    const Placed& placed = placed_[which];
    return placed.link < 0 ? placed.solid.place()
                           : placement.links[static_cast<std::size_t>(placed.link)] * placed.solid.place();
  }

  // The distance of the spheres around them, below zero where they overlap.
  double gap_around(const CheckedPair& pair, const Placement& placement) const {
    return distance(placement.around[pair.a], placement.around[pair.b]) -
           placed_[pair.a].solid.around().radius_m - placed_[pair.b].solid.around().radius_m;
  }

  // Of the spheres of their links, which contain them: not more than the distance of the bodies. Far below
  // zero where there are none. Ends below `enough`.
  double gap_of_spheres(const CheckedPair& pair, const Placement& placement, double enough) const {
    if (placement.centres.empty()) return -1.0;
    const Placed &a = placed_[pair.a], &b = placed_[pair.b];
    const auto link_a = static_cast<std::size_t>(a.link);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first_sphere_[link_a]; i < first_sphere_[link_a + 1]; ++i) {
      const Vector3 centre = placement.centres[i];
      const double radius = spheres_.links[link_a].spheres[i - first_sphere_[link_a]].radius_m;
      if (b.link < 0) {
        least = std::min(least, distance_below(b.obstacle, centre) - radius);
      } else {
        const auto link_b = static_cast<std::size_t>(b.link);
        for (std::size_t k = first_sphere_[link_b]; k < first_sphere_[link_b + 1]; ++k)
          least = std::min(least, distance(centre, placement.centres[k]) - radius -
                                      spheres_.links[link_b].spheres[k - first_sphere_[link_b]].radius_m);
      }
      if (least <= enough) break;
    }
    return least;
  }

  Contact named(const CheckedPair& pair) const { return {placed_[pair.a].name, placed_[pair.b].name}; }

  static std::vector<double> between(std::span<const double> from, std::span<const double> to, double share) {
    std::vector<double> q(from.size());
    for (std::size_t k = 0; k < q.size(); ++k)
      q[k] = share == 1.0 ? to[k] : from[k] + share * (to[k] - from[k]);
    return q;
  }

  // `open`: the pairs that are not yet known to stay apart in this part.
  MotionVerdict check_part(std::span<const double> from, std::span<const double> to, double begin, double end,
                           const std::vector<std::size_t>& open) const {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    const Placement placement = place(between(from, to, middle));
    std::vector<std::size_t> left;
    for (const std::size_t each : open) {
      const CheckedPair& pair = pairs_[each];
      double nearer_m = 0.0;
      for (const Lever& lever : pair.levers)
        nearer_m += half * std::abs(to[lever.column] - from[lever.column]) * lever.most_m;
      if (gap_around(pair, placement) > nearer_m || gap_of_spheres(pair, placement, nearer_m) > nearer_m)
        continue;
      if (nearer_m > kCoarse_m && !placement.centres.empty()) {  // a smaller part is sooner decided
        left.push_back(each);
        continue;
      }
      const double apart_m = distance_below(placed_[pair.a].solid, at(pair.a, placement),
                                            placed_[pair.b].solid, at(pair.b, placement));
      if (apart_m > nearer_m) continue;
      if (apart_m <= 0.0 &&
          meet(placed_[pair.a].solid, at(pair.a, placement), placed_[pair.b].solid, at(pair.b, placement)))
        return {MotionVerdict::Kind::Collides, middle, named(pair)};
      if (nearer_m < kTooClose_m) return {MotionVerdict::Kind::TooClose, middle, named(pair)};
      left.push_back(each);
    }
    if (left.empty()) return {};
    const MotionVerdict first = check_part(from, to, begin, middle, left);
    return first.kind != MotionVerdict::Kind::Free ? first : check_part(from, to, middle, end, left);
  }

  static constexpr double kCoarse_m = 0.02;

  std::shared_ptr<const Base> base_;
  CarryingRobot all_;
  const Robot& robot_;
  LinkFrames kinematics_;
  std::vector<int> coordinates_;
  std::vector<double> rest_;
  const SphereModel& spheres_;
  std::vector<std::size_t> first_sphere_{0};  // of each link, in Placement::centres
  std::vector<Placed> placed_;
  std::vector<CheckedPair> pairs_;
};

result::Result<ExactChecker> ExactChecker::make(const Robot& robot, const Bodies& bodies,
                                                const Semantics* semantics, const World& world,
                                                std::span<const int> coordinates,
                                                std::span<const double> rest, const SphereModel* spheres,
                                                const std::vector<AttachedBody>& attached) {
  if (auto sound = check_world(world); !sound) return result::forward(sound);
  if (auto sound = check_attached(robot, attached); !sound) return result::forward(sound);
  return ExactChecker(std::make_unique<const Scene>(
      Scene::base(robot, bodies, semantics, coordinates, spheres), world, rest, attached));
}

result::Result<ExactChecker> ExactChecker::with(const World& world, std::span<const double> rest,
                                                const std::vector<AttachedBody>& attached) const {
  if (auto sound = check_world(world); !sound) return result::forward(sound);
  if (auto sound = check_attached(scene_->base()->robot, attached); !sound) return result::forward(sound);
  return ExactChecker(std::make_unique<const Scene>(scene_->base(), world, rest, attached));
}

ExactChecker::ExactChecker(std::unique_ptr<const Scene> scene) : scene_(std::move(scene)) {}
ExactChecker::~ExactChecker() = default;
ExactChecker::ExactChecker(ExactChecker&&) noexcept = default;
ExactChecker& ExactChecker::operator=(ExactChecker&&) noexcept = default;

std::size_t ExactChecker::columns() const {
  return scene_->columns();
}

std::optional<Contact> ExactChecker::contact(std::span<const double> configuration) const {
  return scene_->contact(configuration);
}

MotionVerdict ExactChecker::check_motion(std::span<const double> from, std::span<const double> to) const {
  return scene_->check_motion(from, to);
}

}  // namespace stepwright::motion
