#include "supervisor/fleet/program/path_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stepwright::fleet {
namespace {

using geometry::PathPose;
using geometry::Point;
using vehicle::PathLeg;

constexpr double kSame_m = 1e-6;

bool is_stop(const VehicleMission& mission, const PathPose& pose) {
  return std::ranges::any_of(mission.stops,
                             [&](const Stop& stop) { return std::abs(stop.arc_m - pose.arc_m) < kSame_m; });
}

std::vector<PathLeg> legs_of(const VehicleMission& mission) {
  std::vector<PathLeg> legs;
  PathLeg leg;
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

PathLeg sampled(const PathLeg& leg, double sample_m) {
  PathLeg kept = {leg.front()};
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

// Where two polygons overlap the vehicle is within both; the later one is the one that it keeps.
class Rooms {
 public:
  explicit Rooms(const VehicleMission& mission) : mission_(mission) {
    for (const EnvelopePolygon& polygon : mission.grown.envelope.polygons) {
      sides_.push_back(polygon.area.half_planes());
    }
  }

  void add_to(PathSample& sample) const {
    const auto& visits = mission_.grown.visits;
    std::size_t at = 0;
    while (at + 1 < visits.size() && visits[at + 1].entry_m <= sample.arc_m) ++at;
    const auto outline = footprint_at(sample.pose, mission_.model.footprint());
    const Point left{-std::sin(sample.pose.heading_rad), std::cos(sample.pose.heading_rad)};
    sample.left_m = std::min(sample.left_m, room_m(sides_[at], outline, left));
    sample.right_m = std::min(sample.right_m, room_m(sides_[at], outline, -1.0 * left));
  }

 private:
  const VehicleMission& mission_;
  std::vector<std::vector<geometry::HalfPlane>> sides_;
};

}  // namespace

std::vector<PathSample> path_table(const VehicleMission& mission, const ProgramOptions& options) {
  std::vector<PathLeg> legs;
  for (const PathLeg& leg : legs_of(mission)) legs.push_back(sampled(leg, options.sample_m));
  std::vector<PathSample> samples =
      vehicle::path_samples(legs, {.wheelbase_m = mission.model.wheelbase_m,
                                   .speed = {.top_speed_m_s = mission.speed.max_mps,
                                             .brake_m_s2 = options.drive.brake_m_s2,
                                             .lateral_m_s2 = options.drive.lateral_m_s2,
                                             .lock_rate_rad_s = options.drive.lock_rate_rad_s}});
  const Rooms rooms(mission);
  for (PathSample& sample : samples) rooms.add_to(sample);
  return samples;
}

}  // namespace stepwright::fleet
