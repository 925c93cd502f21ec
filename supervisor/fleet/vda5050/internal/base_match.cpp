#include "supervisor/fleet/vda5050/internal/base_match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::fleet::vda5050 {

namespace {

using geometry::Pose;

constexpr double kNear_m = 0.01;
constexpr double kNear_rad = 0.02;

bool near(const Pose& a, const Pose& b) {
  return geometry::distance(a.position(), b.position()) <= kNear_m &&
         std::abs(std::remainder(a.heading_rad - b.heading_rad, 2.0 * std::numbers::pi)) <= kNear_rad;
}

// What is left of the base, with arc lengths that end at zero.
struct Rest {
  std::vector<double> arcs_m;
  std::vector<Pose> poses;
};

Rest rest_of(const VehicleOrder& order) {
  Rest rest;
  const double length = base_length_m(order, order.traversed().value_or(0), order.released());
  double done = 0.0;
  for (std::size_t k = order.traversed().value_or(0); k < order.released(); ++k) {
    const auto& way = order.waypoints()[k].way;
    for (std::size_t p = rest.poses.empty() ? 0 : 1; p < way.size(); ++p) {
      rest.arcs_m.push_back(done + way[p].arc_m - way.front().arc_m - length);
      rest.poses.push_back(way[p].pose);
    }
    done += way.back().arc_m - way.front().arc_m;
  }
  if (rest.poses.empty()) {
    const NodePosition& at = *order.whole().nodes[order.released()].position;
    rest = {{0.0}, {{at.x_m, at.y_m, at.theta_rad.value_or(0.0)}}};
  }
  return rest;
}

Pose pose_at(const Rest& rest, double arc_m) {
  const auto after = std::ranges::lower_bound(rest.arcs_m, arc_m) - rest.arcs_m.begin();
  if (after == 0) return rest.poses.front();
  if (after == std::ssize(rest.arcs_m)) return rest.poses.back();
  const auto b = static_cast<std::size_t>(after), a = b - 1;
  const double part = (arc_m - rest.arcs_m[a]) / (rest.arcs_m[b] - rest.arcs_m[a]);
  const double turn =
      std::remainder(rest.poses[b].heading_rad - rest.poses[a].heading_rad, 2.0 * std::numbers::pi);
  return {std::lerp(rest.poses[a].x_m, rest.poses[b].x_m, part),
          std::lerp(rest.poses[a].y_m, rest.poses[b].y_m, part), rest.poses[a].heading_rad + part * turn};
}

bool follows(const Rest& rest, const geometry::Path& path, std::size_t end) {
  if (path[end].arc_m - path.front().arc_m > -rest.arcs_m.front() + kNear_m) return false;
  for (std::size_t k = 0; k <= end; ++k) {
    if (!near(path[k].pose, pose_at(rest, path[k].arc_m - path[end].arc_m))) return false;
  }
  return true;
}

bool same(const Stop& a, const Stop& b) {
  return a.kind == b.kind && a.location == b.location && a.goal == b.goal && a.amount == b.amount;
}

// Work on the rest of the base must be the mission's, in the same order. What the vehicle is busy with where
// it stands may be missing in the new mission, or still be in it.
bool same_work(const VehicleOrder& order, const VehicleMission& mission, std::size_t end) {
  std::vector<Stop> busy, ahead;
  for (std::size_t k = order.traversed().value_or(0); k <= order.released(); ++k) {
    auto& list = order.traversed() && k == *order.traversed() ? busy : ahead;
    const auto& stops = order.waypoints()[k].stops;
    list.insert(list.end(), stops.begin(), stops.end());
  }
  std::size_t matched = 0;
  for (const Stop& stop : mission.stops) {
    if (stop.pose > end) break;
    const bool is_busy =
        matched == 0 && std::ranges::any_of(busy, [&](const Stop& other) { return same(stop, other); });
    if (is_busy && stop.pose == 0) continue;
    if (matched == ahead.size() || !same(stop, ahead[matched])) return false;
    ++matched;
  }
  return matched == ahead.size();
}

}  // namespace

double base_length_m(const VehicleOrder& order, std::size_t from, std::size_t to) {
  double length = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    const auto& way = order.waypoints()[k].way;
    length += way.back().arc_m - way.front().arc_m;
  }
  return length;
}

std::optional<BaseMatch> match_base(const VehicleOrder& order, const VehicleMission& mission) {
  const Rest rest = rest_of(order);
  for (std::size_t end = 0; end < mission.path.size(); ++end) {
    if (near(mission.path[end].pose, rest.poses.back()) && follows(rest, mission.path, end) &&
        same_work(order, mission, end)) {
      return BaseMatch{end, mission.path[end].arc_m};
    }
  }
  return std::nullopt;
}

}  // namespace stepwright::fleet::vda5050
