#include "supervisor/fleet/vda5050/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "supervisor/geometry/outline.h"

namespace stepwright::fleet::vda5050 {

namespace {

using geometry::Point;

class RouteMaker {
 public:
  RouteMaker(const VehicleMission& mission, const RouteOptions& options, std::size_t from)
      : mission_(mission), options_(options), from_(from) {}

  Route make() {
    find_fixed_poses();
    find_hand_overs();
    Route route;
    for (const std::size_t pose : poses_) {
      if (pose >= from_) route.nodes.push_back(node_at(pose));
    }
    return route;
  }

 private:
  // Where a node is whatever the polygons are.
  void find_fixed_poses() {
    const geometry::Path& path = mission_.path;
    poses_ = {from_, path.size() - 1};
    for (std::size_t s = 0; s < mission_.stops.size(); ++s) {
      poses_.insert(mission_.stops[s].pose);
      stops_[mission_.stops[s].pose].push_back(s);
    }
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      if (path[k + 1].travel != path[k].travel) poses_.insert(k);
    }
  }

  double room_at(std::size_t pose, std::size_t polygon) const {
    const auto& polygons = mission_.grown.envelope.polygons;
    return room_m(polygons[polygon].area, mission_.path[pose].pose, mission_.model.footprint());
  }

  void find_hand_overs() {
    const std::vector<Visit>& visits = mission_.grown.visits;
    std::size_t least = 0;
    const std::set<std::size_t> fixed = poses_;
    for (std::size_t k = 0; k + 1 < visits.size(); ++k) {
      least = hand_over(std::max(least, visits[k + 1].first_pose), visits[k].last_pose, k, fixed);
      hand_overs_.push_back(least);
      poses_.insert(least);
    }
  }

  // A node that is there anyway is as good as one with twice its room.
  std::size_t hand_over(std::size_t first, std::size_t last, std::size_t polygon,
                        const std::set<std::size_t>& fixed) const {
    double best = -std::numeric_limits<double>::infinity();
    std::size_t found = first;
    for (std::size_t pose = first; pose <= last; ++pose) {
      const double room = std::min(room_at(pose, polygon), room_at(pose, polygon + 1));
      const double worth = fixed.contains(pose) ? 2.0 * std::max(room, 0.0) : room;
      if (worth <= best) continue;
      best = worth;
      found = pose;
    }
    return found;
  }

  RouteNode node_at(std::size_t pose) const {
    const auto before = std::ranges::lower_bound(hand_overs_, pose) - hand_overs_.begin();
    const auto until = std::ranges::upper_bound(hand_overs_, pose) - hand_overs_.begin();
    RouteNode node;
    node.pose = pose;
    node.polygon = static_cast<std::uint32_t>(until);
    if (const auto stops = stops_.find(pose); stops != stops_.end()) node.stops = stops->second;
    double room = std::numeric_limits<double>::infinity();
    for (auto k = before; k <= until; ++k) {
      room = std::min(room, room_at(pose, static_cast<std::size_t>(k)));
    }
    if (pose == from_) {
      node.deviation_m = options_.start_deviation_m;
      node.deviation_rad = options_.start_deviation_rad;
      return node;
    }
    const bool stops = !node.stops.empty();
    const double most_m = stops ? options_.stop_deviation_m : options_.most_deviation_m;
    const double most_rad = stops ? options_.stop_deviation_rad : options_.most_deviation_rad;
    // Half the room for the place; what is left for turning, by which a corner moves along its circle.
    node.deviation_m = std::clamp(0.5 * room, 0.0, most_m);
    node.deviation_rad =
        std::clamp((room - node.deviation_m) / mission_.model.circumscribed_radius_m(), 0.0, most_rad);
    return node;
  }

  const VehicleMission& mission_;
  const RouteOptions& options_;
  std::size_t from_;
  std::set<std::size_t> poses_;
  std::map<std::size_t, std::vector<std::size_t>> stops_;
  std::vector<std::size_t> hand_overs_;  // from polygon k to k + 1
};

}  // namespace

Route route_of(const VehicleMission& mission, const RouteOptions& options, std::size_t from) {
  return RouteMaker(mission, options, from).make();
}

std::vector<geometry::PathPose> thinned(const geometry::Path& path, std::size_t first, std::size_t last,
                                        double tolerance_m) {
  std::vector<geometry::PathPose> kept{path[first]};
  // The farthest pose that one chord reaches, again and again.
  for (std::size_t from = first; from < last;) {
    std::size_t to = from + 1;
    while (to < last) {
      const Point a = path[from].pose.position(), b = path[to + 1].pose.position();
      bool near = true;
      for (std::size_t k = from + 1; near && k <= to; ++k) {
        near = geometry::distance_to_side(path[k].pose.position(), a, b) <= tolerance_m;
      }
      if (!near) break;
      ++to;
    }
    kept.push_back(path[to]);
    from = to;
  }
  return kept;
}

double room_m(const geometry::ConvexPolygon& polygon, const geometry::Pose& pose,
              const geometry::Footprint& footprint) {
  double room = std::numeric_limits<double>::infinity();
  const geometry::ConvexPolygon outline = geometry::footprint_at(pose, footprint);
  for (const geometry::HalfPlane& side : polygon.half_planes()) {
    for (const Point corner : outline.corners()) {
      room = std::min(room, side.offset_m - geometry::dot(side.normal, corner));
    }
  }
  return room;
}

}  // namespace stepwright::fleet::vda5050
