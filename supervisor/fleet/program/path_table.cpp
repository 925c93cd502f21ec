#include "supervisor/fleet/program/path_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "supervisor/fleet/control/greatest_speeds.h"

namespace stepwright::fleet {
namespace {

using geometry::PathPose;
using geometry::Point;
using geometry::Travel;

constexpr double kSame_m = 1e-6;

// The poses that become samples, from one place of rest to the next.
using Leg = std::vector<PathPose>;

bool is_stop(const VehicleMission& mission, const PathPose& pose) {
  return std::ranges::any_of(mission.stops,
                             [&](const Stop& stop) { return std::abs(stop.arc_m - pose.arc_m) < kSame_m; });
}

std::vector<Leg> legs_of(const VehicleMission& mission) {
  std::vector<Leg> legs;
  Leg leg;
  for (const PathPose& pose : mission.path) {
    if (!leg.empty() && pose.arc_m <= leg.back().arc_m + kSame_m) continue;
    const bool turns = leg.size() >= 2 && pose.travel != leg.back().travel;
    const bool rests = leg.size() >= 2 && is_stop(mission, leg.back());
    if (turns || rests) {
      const PathPose last = leg.back();
      legs.push_back(std::move(leg));
      leg = {last};
    }
    leg.push_back(pose);
  }
  if (leg.size() >= 2) legs.push_back(std::move(leg));
  return legs;
}

Leg thinned(const Leg& leg, double sample_m) {
  Leg kept = {leg.front()};
  for (std::size_t k = 1; k + 1 < leg.size(); ++k) {
    if (leg[k + 1].arc_m - kept.back().arc_m > sample_m + kSame_m) kept.push_back(leg[k]);
  }
  // A last bit that is very short would have a curvature of rounding.
  const bool short_end = leg.back().arc_m - kept.back().arc_m < 0.25 * sample_m;
  if (short_end && kept.size() > 1) kept.pop_back();
  kept.push_back(leg.back());
  return kept;
}

// How far the outline may shift along `aside` within the polygon.
double room_m(const std::vector<geometry::HalfPlane>& sides, const geometry::ConvexPolygon& outline,
              Point aside) {
  double room = std::numeric_limits<double>::infinity();
  for (const geometry::HalfPlane& side : sides) {
    const double towards = geometry::dot(side.normal, aside);
    if (towards < 1e-6) continue;
    for (const Point corner : outline.corners()) {
      const double left = side.offset_m - geometry::dot(side.normal, corner);
      room = std::min(room, std::max(0.0, left) / towards);
    }
  }
  return room;
}

class Table {
 public:
  Table(const VehicleMission& mission, const ProgramOptions& options) : mission_(mission), options_(options) {
    for (const EnvelopePolygon& polygon : mission.grown.envelope.polygons) {
      sides_.push_back(polygon.area.half_planes());
    }
  }

  std::vector<PathSample> make() {
    for (const Leg& leg : legs_of(mission_)) add(thinned(leg, options_.sample_m));
    return std::move(samples_);
  }

 private:
  void add(const Leg& leg) {
    const std::size_t first = samples_.size();
    const double way = leg.back().travel == Travel::Reverse ? -1.0 : 1.0;
    double heading = first == 0 ? leg.front().pose.heading_rad : samples_.back().pose.heading_rad;
    for (const PathPose& pose : leg) {
      heading += std::remainder(pose.pose.heading_rad - heading, 2.0 * std::numbers::pi);
      PathSample sample{.pose = {pose.pose.x_m, pose.pose.y_m, heading},
                        .arc_m = pose.arc_m,
                        .rest_m = leg.back().arc_m,
                        .way = way};
      if (samples_.size() > first) {
        PathSample& before = samples_.back();
        before.curvature_1_m = way * (heading - before.pose.heading_rad) / (sample.arc_m - before.arc_m);
        sample.curvature_1_m = before.curvature_1_m;
      }
      add_room(sample);
      samples_.push_back(sample);
    }
    limit_speeds(first);
  }

  // Where two polygons overlap the vehicle is within both; the later one is the one that it keeps.
  void add_room(PathSample& sample) const {
    const auto& visits = mission_.grown.visits;
    std::size_t at = 0;
    while (at + 1 < visits.size() && visits[at + 1].entry_m <= sample.arc_m) ++at;
    const auto outline = footprint_at(sample.pose, mission_.model.footprint());
    const Point left{-std::sin(sample.pose.heading_rad), std::cos(sample.pose.heading_rad)};
    constexpr double kEnough_m = 10.0;
    sample.left_m = std::min(kEnough_m, room_m(sides_[at], outline, left));
    sample.right_m = std::min(kEnough_m, room_m(sides_[at], outline, -1.0 * left));
  }

  double lock_at(std::size_t first, double arc_m) const {
    std::size_t k = first;
    while (k + 1 < samples_.size() && samples_[k + 1].arc_m <= arc_m) ++k;
    return std::atan(mission_.model.wheelbase_m * samples_[k].curvature_1_m);
  }

  void limit_speeds(std::size_t first) {
    std::vector<SpeedStation> stations;
    for (std::size_t k = first; k < samples_.size(); ++k) {
      const double arc_m = samples_[k].arc_m;
      const double before = k > first ? std::abs(samples_[k - 1].curvature_1_m) : 0.0;
      stations.push_back({.sharpest_1_m = std::max(std::abs(samples_[k].curvature_1_m), before),
                          .turn_rad = lock_at(first, arc_m + kSteeringWindow_m / 2.0) -
                                      lock_at(first, arc_m - kSteeringWindow_m / 2.0),
                          .to_next_m = k + 1 < samples_.size() ? samples_[k + 1].arc_m - arc_m : 0.0});
    }
    const std::vector<double> speeds =
        greatest_speeds(stations, {.top_speed_m_s = mission_.speed.max_mps,
                                   .brake_m_s2 = options_.drive.brake_m_s2,
                                   .lateral_m_s2 = options_.drive.lateral_m_s2,
                                   .lock_rate_rad_s = options_.drive.lock_rate_rad_s});
    for (std::size_t k = first; k < samples_.size(); ++k) samples_[k].speed_m_s = speeds[k - first];
  }

  const VehicleMission& mission_;
  const ProgramOptions& options_;
  std::vector<std::vector<geometry::HalfPlane>> sides_;
  std::vector<PathSample> samples_;
};

}  // namespace

std::vector<PathSample> path_table(const VehicleMission& mission, const ProgramOptions& options) {
  return Table(mission, options).make();
}

}  // namespace stepwright::fleet
