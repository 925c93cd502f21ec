#include "supervisor/fleet/control/leg.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace stepwright::fleet {

using geometry::PathPose;
using geometry::Point;
using geometry::Pose;
using geometry::Travel;

namespace {

double turn_between(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

}  // namespace

Leg::Leg(std::vector<PathPose> poses, double wheelbase_m)
    : wheelbase_m_(wheelbase_m), reverse_(poses.back().travel == Travel::Reverse) {
  assert(poses.size() >= 2);
  for (const PathPose& pose : poses) points_.push_back({pose.pose, pose.arc_m, 0.0});
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const double turn = turn_between(points_[k - 1].pose.heading_rad, points_[k].pose.heading_rad);
    points_[k].pose.heading_rad = points_[k - 1].pose.heading_rad + turn;
    points_[k - 1].curvature_1_m = sign() * turn / (points_[k].arc_m - points_[k - 1].arc_m);
  }
  points_.back().curvature_1_m = points_[points_.size() - 2].curvature_1_m;
}

std::size_t Leg::index_at(double arc_m) const {
  const auto after = std::ranges::upper_bound(points_, arc_m, {}, &Sample::arc_m);
  const auto index = static_cast<std::size_t>(after - points_.begin());
  return std::clamp<std::size_t>(index, 1, points_.size() - 1) - 1;
}

LegPoint Leg::at(double arc_m) const {
  const std::size_t k = index_at(arc_m);
  const Sample& a = points_[k];
  const Sample& b = points_[k + 1];
  const double part = std::clamp((arc_m - a.arc_m) / (b.arc_m - a.arc_m), 0.0, 1.0);
  const auto between = [part](double from, double to) { return from + part * (to - from); };
  const Pose pose{between(a.pose.x_m, b.pose.x_m), between(a.pose.y_m, b.pose.y_m),
                  between(a.pose.heading_rad, b.pose.heading_rad)};
  return {pose, std::atan(wheelbase_m_ * between(a.curvature_1_m, b.curvature_1_m))};
}

double Leg::sharpest_1_m(double from_m, double to_m) const {
  double sharpest = 0.0;
  for (std::size_t k = index_at(from_m); k < points_.size() && points_[k].arc_m <= to_m; ++k) {
    sharpest = std::max(sharpest, std::abs(points_[k].curvature_1_m));
  }
  return sharpest;
}

double Leg::nearest_m(Point place, double from_m, double to_m) const {
  double best_m = from_m;
  double least = geometry::distance(place, at(from_m).pose.position());
  for (std::size_t k = index_at(from_m); k + 1 < points_.size() && points_[k].arc_m <= to_m; ++k) {
    const Point a = points_[k].pose.position();
    const Point along = points_[k + 1].pose.position() - a;
    const double part = std::clamp(geometry::dot(place - a, along) / geometry::dot(along, along), 0.0, 1.0);
    const double arc = points_[k].arc_m + part * (points_[k + 1].arc_m - points_[k].arc_m);
    if (arc < from_m || arc > to_m) continue;
    const double away = geometry::distance(place, a + part * along);
    if (away < least) least = away, best_m = arc;
  }
  return best_m;
}

std::vector<Leg> split_into_legs(const geometry::Path& path, double wheelbase_m) {
  std::vector<Leg> legs;
  std::vector<PathPose> part;
  const auto close = [&] {
    if (part.size() >= 2) legs.emplace_back(std::move(part), wheelbase_m);
    part.clear();
  };
  for (const PathPose& pose : path) {
    if (part.empty()) {
      part.push_back(pose);
      continue;
    }
    if (pose.arc_m <= part.back().arc_m) continue;
    if (part.size() >= 2 && pose.travel != part.back().travel) {
      const PathPose cusp = part.back();
      close();
      part.push_back(cusp);
    }
    part.push_back(pose);
  }
  close();
  return legs;
}

}  // namespace stepwright::fleet
