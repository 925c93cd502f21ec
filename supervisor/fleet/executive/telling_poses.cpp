#include "supervisor/fleet/executive/telling_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::fleet {
namespace {

constexpr double kBesides_m = 0.005;
constexpr double kFarthest_m = 1.0;
// Of a chord's ends: whoever reads headings between two poses reads them from these.
constexpr double kTurn_rad = 0.15;

std::vector<bool> marked(const VehicleMission& mission) {
  std::vector<bool> marks(mission.path.size(), false);
  const auto mark = [&](std::size_t k) {
    if (k < marks.size()) marks[k] = true;
  };
  mark(0);
  mark(marks.size() - 1);
  for (const Stop& stop : mission.stops) mark(stop.pose);
  for (const Visit& visit : mission.grown.visits) {
    mark(visit.first_pose);
    mark(visit.last_pose);
  }
  for (std::size_t k = 1; k + 1 < mission.path.size(); ++k) {
    if (mission.path[k].travel != mission.path[k + 1].travel) mark(k);
  }
  return marks;
}

// Whether the poses between are where the straight line is.
bool spans(const geometry::Path& path, std::size_t from, std::size_t to) {
  const geometry::Pose &a = path[from].pose, &b = path[to].pose;
  const double turn = std::remainder(b.heading_rad - a.heading_rad, 2.0 * std::numbers::pi);
  const geometry::Point along = b.position() - a.position();
  const double length_m = std::hypot(along.x_m, along.y_m);
  if (std::abs(turn) > kTurn_rad || path[to].arc_m - path[from].arc_m > kFarthest_m || length_m == 0.0)
    return false;
  for (std::size_t k = from + 1; k < to; ++k) {
    const double off_m = geometry::cross(along, path[k].pose.position() - a.position()) / length_m;
    if (std::abs(off_m) > kBesides_m) return false;
  }
  return true;
}

}  // namespace

std::vector<std::size_t> telling_poses(const VehicleMission& mission) {
  std::vector<std::size_t> kept;
  if (mission.path.empty()) return kept;
  const std::vector<bool> marks = marked(mission);
  for (std::size_t at = 0; at < mission.path.size();) {
    kept.push_back(at);
    std::size_t next = at + 1;
    while (next + 1 < mission.path.size() && !marks[next] && spans(mission.path, at, next + 1)) ++next;
    at = next;
  }
  return kept;
}

}  // namespace stepwright::fleet
