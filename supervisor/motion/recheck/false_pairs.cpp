#include "supervisor/motion/recheck/false_pairs.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/recheck/exact_checker.h"
#include "supervisor/motion/spatial/random.h"

namespace stepwright::motion {

namespace {

class PairSample {
 public:
  PairSample(const Robot& robot, const Bodies& bodies, const SphereModel& spheres, Semantics semantics,
             std::span<const int> coordinates, std::span<const double> rest)
      : robot_(robot),
        bodies_(bodies),
        spheres_(spheres),
        coordinates_(coordinates),
        rest_(rest.begin(), rest.end()) {
    found_.for_spheres = std::move(semantics);
  }

  FalsePairs judge(std::size_t count, double least_share) {
    draw(count);
    const auto links = static_cast<int>(robot_.links.size());
    for (int a = 0; a < links; ++a)
      for (int b = a + 1; b < links; ++b)
        if (!found_.for_spheres.is_disabled(a, b)) judge_pair(a, b, least_share);
    found_.bodies.resize(bodies_.size());
    for (const auto& [a, b] : found_.pairs)
      for (const auto each : {static_cast<std::size_t>(a), static_cast<std::size_t>(b)})
        found_.bodies[each] = bodies_[each];
    for (int a = 0; a < links; ++a)
      for (int b = a + 1; b < links; ++b)
        if (std::ranges::find(found_.pairs, std::pair(a, b)) == found_.pairs.end())
          found_.only_pairs.disabled.emplace_back(a, b);
    auto& disabled = found_.for_spheres.disabled;
    disabled.insert(disabled.end(), found_.pairs.begin(), found_.pairs.end());
    std::sort(disabled.begin(), disabled.end());
    return std::move(found_);
  }

 private:
  void draw(std::size_t count) {
    Random random(1);
    const LinkFrames kinematics(robot_);
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<double> row, all = rest_;
      for (const int each : coordinates_) {
        const Coordinate& limits = robot_.coordinates[static_cast<std::size_t>(each)];
        row.push_back(random.between(std::max(limits.lower, -std::numbers::pi),
                                     std::min(limits.upper, std::numbers::pi)));
        all[static_cast<std::size_t>(each)] = row.back();
      }
      rows_.push_back(std::move(row));
      frames_.emplace_back(robot_.links.size());
      kinematics.place(all, frames_.back());
    }
  }

  static bool overlap(const LinkSpheres& a, const Transform& at_a, const LinkSpheres& b,
                      const Transform& at_b) {
    return std::ranges::any_of(a.spheres, [&](const Sphere& one) {
      const Vector3 centre = at_a * one.centre_m;
      return std::ranges::any_of(b.spheres, [&](const Sphere& other) {
        return distance(centre, at_b * other.centre_m) <= one.radius_m + other.radius_m;
      });
    });
  }

  // By FCL, with the bodies of the two links alone, wherever their spheres overlap.
  void judge_pair(int a, int b, double least_share) {
    const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
    std::vector<std::size_t> overlapping;
    for (std::size_t k = 0; k < frames_.size(); ++k)
      if (overlap(spheres_.links[first], frames_[k][first], spheres_.links[second], frames_[k][second]))
        overlapping.push_back(k);
    if (static_cast<double>(overlapping.size()) <= least_share * static_cast<double>(frames_.size())) return;
    Bodies both(bodies_.size());
    for (const std::size_t each : {first, second}) both[each] = bodies_[each];
    const Semantics none{};
    const auto exact = ExactChecker::make(robot_, both, &none, {}, coordinates_, rest_);
    if (!exact) return;
    std::size_t meeting = 0;
    for (const std::size_t each : overlapping) meeting += exact->contact(rows_[each]).has_value();
    if (meeting == rows_.size())
      found_.always.emplace_back(a, b);
    else if (10 * meeting < overlapping.size())
      found_.pairs.emplace_back(a, b);
  }

  const Robot& robot_;
  const Bodies& bodies_;
  const SphereModel& spheres_;
  std::span<const int> coordinates_;
  std::vector<double> rest_;
  std::vector<std::vector<double>> rows_;
  std::vector<std::vector<Transform>> frames_;
  FalsePairs found_;
};

}  // namespace

FalsePairs false_pairs(const Robot& robot, const Bodies& bodies, const SphereModel& spheres,
                       const Semantics* semantics, std::span<const int> coordinates,
                       std::span<const double> rest, std::size_t count, double least_share) {
  Semantics given = semantics ? *semantics : carrying(robot, nullptr, nullptr, nullptr, {}).semantics;
  return PairSample(robot, bodies, spheres, std::move(given), coordinates, rest).judge(count, least_share);
}

}  // namespace stepwright::motion
