#include "supervisor/tamp/predicates/arm_ways.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::tamp::predicates {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

motion::Transform tip_of(const scene::ArmModel& arm, const ToolPlace& place, double up_m) {
  return inverse(arm.base) * scene::tool_pose(place.x_m, place.y_m, place.z_m + up_m, place.angle_rad);
}

void add_ways(const scene::ArmModel& arm, const motion::Transform& top, motion::SrsBranch branch,
              double from_rad, double to_rad, std::vector<ArmWay>& ways) {
  constexpr double kWide_rad = 0.6;
  const double width = to_rad - from_rad;
  const auto add = [&](double swivel) {
    // Below it is sure to be one: the swivel is within the arc there.
    if (const auto high = arm.kinematics.solve(top, swivel, branch))
      ways.push_back({swivel, branch, high->q, 0.0});
  };
  add(from_rad + 0.5 * width);
  if (width <= kWide_rad) return;
  add(from_rad + 0.2 * width);
  add(from_rad + 0.8 * width);
}

}  // namespace

std::vector<ArmWay> arm_ways(const scene::ArmModel& arm, const ToolPlace& place, double lift_m,
                             const scene::JointValues& from) {
  std::vector<ArmWay> ways = all_ways(arm, place, lift_m);
  sort_ways(ways, from);
  return ways;
}

void sort_ways(std::vector<ArmWay>& ways, const scene::JointValues& from) {
  for (ArmWay& each : ways) each.far = motion::joint_distance(each.top, from);
  std::stable_sort(ways.begin(), ways.end(), [](const ArmWay& a, const ArmWay& b) { return a.far < b.far; });
}

std::vector<ArmWay> all_ways(const scene::ArmModel& arm, const ToolPlace& place, double lift_m) {
  const motion::Transform bottom = tip_of(arm, place, 0.0), top = tip_of(arm, place, lift_m);
  std::vector<ArmWay> ways;
  const std::vector<motion::SwivelArc> low = arm.kinematics.arcs(bottom);
  if (low.empty()) return ways;
  const std::vector<motion::SwivelArc> high = arm.kinematics.arcs(top);
  for (const motion::SwivelArc& a : low)
    for (const motion::SwivelArc& b : high) {
      if (!(a.branch == b.branch)) continue;
      for (const double turn : {-kTurn, 0.0, kTurn}) {
        const double first = std::max(a.from_rad, b.from_rad + turn),
                     last = std::min(a.to_rad, b.to_rad + turn);
        if (first < last) add_ways(arm, top, a.branch, first, last, ways);
      }
    }
  return ways;
}

std::optional<motion::JointPath> line_of(const scene::ArmModel& arm, const ToolPlace& place, double lift_m,
                                         double step_m, const ArmWay& way) {
  constexpr double kJump_rad = 0.35;
  const int steps = std::max(1, static_cast<int>(std::ceil(lift_m / step_m)));
  motion::JointPath line;
  for (int k = 0; k <= steps; ++k) {
    const auto found =
        arm.kinematics.solve(tip_of(arm, place, lift_m * k / steps), way.swivel_rad, way.branch);
    if (!found) return std::nullopt;
    if (!line.empty())
      for (std::size_t j = 0; j < found->q.size(); ++j)
        if (std::abs(found->q[j] - line.back()[j]) > kJump_rad) return std::nullopt;
    line.emplace_back(found->q.begin(), found->q.end());
  }
  return line;
}

}  // namespace stepwright::tamp::predicates
