#include "supervisor/tamp/predicates/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace stepwright::tamp::predicates {

namespace {

std::array<double, 7> array_of(const motion::Configuration& q) {
  std::array<double, 7> out{};
  std::copy_n(q.begin(), out.size(), out.begin());
  return out;
}

// Half-way between two tools that hang down, higher by `up_m`; nothing where the arm stands in different
// ways, does not hang down, or cannot be there.
std::optional<motion::Configuration> between(const scene::ArmModel& arm, const motion::Configuration& from,
                                             const motion::Configuration& to, double up_m) {
  constexpr double kHangs = 1e-6;
  const auto low = array_of(from), high = array_of(to);
  if (!(arm.kinematics.branch(low) == arm.kinematics.branch(high))) return std::nullopt;
  const motion::Transform a = arm.base * arm.kinematics.forward(low),
                          b = arm.base * arm.kinematics.forward(high);
  for (const motion::Transform* each : {&a, &b})
    if (each->rotation.column(2).z > kHangs - 1.0) return std::nullopt;
  const auto half_way = [](double one, double other) {
    return one + 0.5 * std::remainder(other - one, 2.0 * std::numbers::pi);
  };
  const motion::Vector3 ahead_a = a.rotation.column(0), ahead_b = b.rotation.column(0);
  const double angle_rad = half_way(std::atan2(ahead_a.y, ahead_a.x), std::atan2(ahead_b.y, ahead_b.x));
  const double swivel_rad = half_way(arm.kinematics.swivel(low), arm.kinematics.swivel(high));
  const motion::Vector3 middle = 0.5 * (a.position_m + b.position_m);
  const motion::Transform tip =
      inverse(arm.base) *
      scene::tool_pose(middle.x, middle.y, std::max(a.position_m.z, b.position_m.z) + up_m, angle_rad);
  const auto found = arm.kinematics.solve(tip, swivel_rad, arm.kinematics.branch(low));
  if (!found) return std::nullopt;
  return motion::Configuration(found->q.begin(), found->q.end());
}

// The same, higher by `up_m`; nothing if the tool does not hang down, or the arm cannot be there.
std::optional<motion::Configuration> raised(const scene::ArmModel& arm, const motion::Configuration& q,
                                            double up_m) {
  constexpr double kHangs = 1e-6;
  const auto values = array_of(q);
  motion::Transform tip = arm.base * arm.kinematics.forward(values);
  if (tip.rotation.column(2).z > kHangs - 1.0) return std::nullopt;
  tip.position_m.z += up_m;
  const auto found = arm.kinematics.solve(inverse(arm.base) * tip, arm.kinematics.swivel(values),
                                          arm.kinematics.branch(values));
  if (!found) return std::nullopt;
  return motion::Configuration(found->q.begin(), found->q.end());
}

}  // namespace

Transfer transfer(const motion::CollisionChecker& checker, const motion::JointSpace& space,
                  const scene::ArmModel& arm, const motion::Configuration& from,
                  const motion::Configuration& to, const motion::PathOptions& options) {
  const auto free = [&](const motion::Configuration& a, const motion::Configuration& b) {
    return checker.motion_is_free(a, b, options.step);
  };
  if (motion::inside(space, from) && motion::inside(space, to)) {
    if (free(from, to)) return {{from, to}, Means::Straight};
    constexpr double kUp_m = 0.1;
    const auto by_way_of = [&](const std::vector<std::optional<motion::Configuration>>& through) {
      motion::JointPath path{from};
      for (const auto& each : through) {
        if (!each) return motion::JointPath{};
        path.push_back(*each);
      }
      path.push_back(to);
      for (std::size_t k = 1; k < path.size(); ++k)
        if (!free(path[k - 1], path[k])) return motion::JointPath{};
      return path;
    };
    const motion::Configuration home(arm.home.begin(), arm.home.end());
    const auto above_from = raised(arm, from, kUp_m), above_to = raised(arm, to, kUp_m);
    for (const auto& through :
         {std::vector{between(arm, from, to, 0.0)}, std::vector{between(arm, from, to, kUp_m)},
          std::vector{above_to}, std::vector{above_from}, std::vector{above_from, above_to},
          std::vector{std::optional(home)}})
      if (auto path = by_way_of(through); !path.empty()) return {std::move(path), Means::ByWayOf};
  }
  motion::PathAnswer answer = motion::plan_path(checker, space, from, {to}, options);
  return {std::move(answer.path), Means::Trees, answer.motions};
}

}  // namespace stepwright::tamp::predicates
