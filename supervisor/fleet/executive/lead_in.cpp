#include "supervisor/fleet/executive/lead_in.h"

#include <algorithm>
#include <cmath>

#include "supervisor/fleet/lattice/heading.h"
#include "supervisor/fleet/lattice/primitive_set.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet {
namespace {

using geometry::Path;
using geometry::PathPose;
using geometry::Travel;

constexpr double kThere_m = 0.08;

Travel turned(Travel travel) {
  return travel == Travel::Forward ? Travel::Reverse : Travel::Forward;
}

Path onward(const Path& path, std::size_t from, std::size_t to) {
  Path way(path.begin() + static_cast<std::ptrdiff_t>(from),
           path.begin() + static_cast<std::ptrdiff_t>(to) + 1);
  const double begun_m = way.front().arc_m;
  for (PathPose& at : way) at.arc_m -= begun_m;
  if (way.size() > 1) way.front().travel = way[1].travel;
  return way;
}

Path backward(const Path& path, std::size_t from, std::size_t to) {
  Path way;
  for (std::size_t k = from + 1; k-- > to;) {
    const std::size_t came = std::min(k + 1, from);  // whose travel led from k to k + 1
    way.push_back({path[k].pose, path[from].arc_m - path[k].arc_m, turned(path[came].travel)});
  }
  return way;
}

std::size_t nearest(const Path& path, double arc_m) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    if (std::abs(path[k].arc_m - arc_m) < std::abs(path[best].arc_m - arc_m)) best = k;
  }
  return best;
}

}  // namespace

bool on_lattice(const geometry::Pose& pose, const GridFrame& frame) {
  const auto at_vertex = [](double value) {
    const double steps = value / LatticeOptions{}.resolution_m;
    return std::abs(steps - std::round(steps)) < 1e-6;
  };
  return at_vertex(pose.x_m - frame.origin.x_m) && at_vertex(pose.y_m - frame.origin.y_m) &&
         std::cos(pose.heading_rad - heading_rad(nearest_heading(pose.heading_rad))) > 1.0 - 1e-12;
}

std::vector<LeadIn> lead_ins(const Path& path, double arc_m, const GridFrame& frame) {
  std::vector<LeadIn> ways;
  if (path.empty()) return ways;
  const std::size_t here = nearest(path, arc_m);
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (std::abs(path[k].arc_m - arc_m) > kThere_m || !on_lattice(path[k].pose, frame)) continue;
    return {{.path = onward(path, k, k), .start = path[k].pose}};
  }
  for (std::size_t k = here; k < path.size(); ++k) {
    if (!on_lattice(path[k].pose, frame)) continue;
    ways.push_back({.path = onward(path, here, k), .start = path[k].pose});
    break;
  }
  for (std::size_t k = here + 1; k-- > 0;) {
    if (!on_lattice(path[k].pose, frame)) continue;
    ways.push_back({.path = backward(path, here, k), .start = path[k].pose});
    break;
  }
  return ways;
}

bool is_free(const Path& path, const geometry::Footprint& outline, const OccupancyGrid& map) {
  return std::ranges::none_of(
      path, [&](const PathPose& at) { return meets_obstacle(map, footprint_at(at.pose, outline)); });
}

}  // namespace stepwright::fleet
