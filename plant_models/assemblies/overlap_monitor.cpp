#include "plant_models/assemblies/overlap_monitor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace stepwright::assemblies {
namespace {

using body2d::Vec2;

using Outline = OverlapMonitor::Outline;

Outline rectangle(const body2d::Pose& pose, double front_m, double rear_m, double half_width_m) {
  const double c = std::cos(pose.angle);
  const double s = std::sin(pose.angle);
  const auto at = [&](double ahead, double aside) {
    return Vec2{pose.position.x + c * ahead - s * aside, pose.position.y + s * ahead + c * aside};
  };
  return {{at(front_m, half_width_m), at(-rear_m, half_width_m), at(-rear_m, -half_width_m),
           at(front_m, -half_width_m)},
          at(0.5 * (front_m - rear_m), 0.0),
          std::hypot(0.5 * (front_m + rear_m), half_width_m),
          true};
}

double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}

// The greatest distance between the two along the normal of a side of `a`: negative where none of them
// separates.
double apart(const Outline& a, const Outline& b) {
  double most = -1e9;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 from = a.corners[k];
    const Vec2 to = a.corners[(k + 1) % 4];
    const double side_m = std::hypot(to.x - from.x, to.y - from.y);
    const Vec2 normal{(to.y - from.y) / side_m, -(to.x - from.x) / side_m};
    double least = 1e9;
    for (const Vec2 corner : b.corners)
      least = std::min(least, dot(normal, {corner.x - from.x, corner.y - from.y}));
    most = std::max(most, least);
  }
  return most;
}

double distance(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along{to.x - from.x, to.y - from.y};
  const Vec2 way{point.x - from.x, point.y - from.y};
  const double part = std::clamp(dot(way, along) / dot(along, along), 0.0, 1.0);
  return std::hypot(way.x - part * along.x, way.y - part * along.y);
}

// Of two outlines that are apart: from a corner of one to a side of the other.
double gap(const Outline& a, const Outline& b) {
  double least = 1e9;
  for (const auto& [first, second] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Vec2 corner : first->corners) {
      for (std::size_t k = 0; k < 4; ++k)
        least = std::min(least, distance(corner, second->corners[k], second->corners[(k + 1) % 4]));
    }
  }
  return least;
}

bool overlap(const Outline& a, const Outline& b) {
  return apart(a, b) < 0.0 && apart(b, a) < 0.0;
}

bool far(const Outline& a, const Outline& b, double more_than_m) {
  return std::hypot(a.middle.x - b.middle.x, a.middle.y - b.middle.y) > a.reach_m + b.reach_m + more_than_m;
}

}  // namespace

OverlapMonitor::OverlapMonitor(const FleetParameters& parameters)
    : body_(parameters.forklift.body), vehicles_(parameters.starts.size()), walls_(parameters.walls.size()) {
  for (const auto* blocks : {&parameters.walls, &parameters.blockages}) {
    for (const BlockParameters& block : *blocks) {
      const Vec2 size = block.rectangle.size;
      obstacles_.push_back(rectangle(block.pose, 0.5 * size.x, 0.5 * size.x, 0.5 * size.y));
    }
  }
  for (std::size_t k = 0; k < parameters.blockages.size(); ++k) set_present(k, false);
}

void OverlapMonitor::put(std::size_t vehicle, const ForkliftPose& at) {
  vehicles_[vehicle] =
      rectangle({{at.x_m, at.y_m}, at.heading_rad}, body_.front_m, body_.rear_m, 0.5 * body_.width_m);
}

void OverlapMonitor::set_present(std::size_t blockage, bool present) {
  obstacles_[walls_ + blockage].present = present;
}

void OverlapMonitor::look() {
  for (std::size_t a = 0; a < vehicles_.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (far(vehicles_[a], vehicles_[b], smallest_gap_m_)) continue;
      const bool together = overlap(vehicles_[a], vehicles_[b]);
      if (together) ++overlaps_;
      smallest_gap_m_ = together ? 0.0 : std::min(smallest_gap_m_, gap(vehicles_[a], vehicles_[b]));
    }
    for (const Outline& obstacle : obstacles_) {
      if (obstacle.present && !far(vehicles_[a], obstacle, 0.0) && overlap(vehicles_[a], obstacle))
        ++obstacle_overlaps_;
    }
  }
}

}  // namespace stepwright::assemblies
