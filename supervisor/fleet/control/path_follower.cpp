#include "supervisor/fleet/control/path_follower.h"

#include <algorithm>
#include <cmath>

namespace stepwright::fleet {
namespace {

// How far the place on the path is looked for, behind and before where it was.
constexpr double kBehind_m = 0.3;
constexpr double kBefore_m = 1.0;
constexpr double kTurnRound_s = 0.5;  // at a cusp, with the steering
constexpr double kStands_m_s = 0.05;  // also with what a measurement is off
constexpr double kSteers_rad = 0.2;   // what the steering may make up for on the way
constexpr double kMoved_m = 0.1;      // who comes no farther than this does not drive
constexpr double kLongest_s = 24.0 * 3600.0;

// A drive that follows its set point with this lag moves by `rate` times a step if the set point, which holds
// for the step, is so many seconds of that rate ahead.
double ahead_s(double lag_s) {
  return lag_s > 0.0 ? kControlStep_s / (1.0 - std::exp(-kControlStep_s / lag_s)) : kControlStep_s;
}

bool finite(const VehicleState& s) {
  return std::isfinite(s.x_m) && std::isfinite(s.y_m) && std::isfinite(s.heading_rad) &&
         std::isfinite(s.speed_m_s) && std::isfinite(s.lock_rad);
}

bool finite(const geometry::PathPose& p) {
  return std::isfinite(p.pose.x_m) && std::isfinite(p.pose.y_m) && std::isfinite(p.pose.heading_rad) &&
         std::isfinite(p.arc_m);
}

}  // namespace

result::Result<PathFollower> PathFollower::create(const geometry::Path& path, std::span<const PathArea> areas,
                                                  const DriveLimits& limits,
                                                  const geometry::Footprint& footprint,
                                                  const FollowerSettings& settings) {
  if (!std::ranges::all_of(path, [](const geometry::PathPose& p) { return finite(p); })) {
    return result::fail("F1201", {}, "the path has a number that is none");
  }
  std::vector<Section> sections;
  for (Leg& leg : split_into_legs(path, limits.wheelbase_m)) {
    SpeedPlan plan(leg, limits);
    sections.push_back({std::move(leg), std::move(plan)});
  }
  if (sections.empty())
    return result::fail("F1201", {}, "the path goes nowhere", "it needs two poses at different places");
  std::vector<Area> sides;
  for (const PathArea& area : areas) sides.push_back({area.polygon.half_planes(), area.entry_m, area.exit_m});
  return PathFollower(std::move(sections), std::move(sides), limits, footprint, settings);
}

PathFollower::PathFollower(std::vector<Section> sections, std::vector<Area> areas, const DriveLimits& limits,
                           const geometry::Footprint& footprint, const FollowerSettings& settings)
    : sections_(std::move(sections)),
      areas_(std::move(areas)),
      limits_(limits),
      settings_(settings),
      controller_(limits, footprint, settings.weights),
      arc_m_(sections_.front().leg.begin_m()) {}

// Where two polygons overlap the vehicle is within both; the later one lets it go on.
std::span<const geometry::HalfPlane> PathFollower::area_at(double arc_m) const {
  std::span<const geometry::HalfPlane> found;
  for (const Area& area : areas_) {
    if (area.entry_m <= arc_m && arc_m <= area.exit_m) found = area.sides;
  }
  return found;
}

// It may have run past it.
bool PathFollower::at_end_of_leg(const VehicleState& measured) const {
  const Leg& leg = section().leg;
  const geometry::Pose end = leg.at(leg.end_m()).pose;
  const geometry::Point way{measured.x_m - end.x_m, measured.y_m - end.y_m};
  const double along = geometry::dot(way, {std::cos(end.heading_rad), std::sin(end.heading_rad)});
  return std::abs(measured.speed_m_s) <= settings_.arrived_m_s &&
         leg.end_m() - arc_m_ <= settings_.arrived_m && std::abs(along) <= settings_.arrived_m;
}

void PathFollower::find_place(const VehicleState& measured) {
  const Leg* leg = &section().leg;
  if (at_end_of_leg(measured)) {
    if (at_ + 1 == sections_.size()) {
      arrived_ = true;
    } else {
      ++at_;
      leg = &section().leg;
      arc_m_ = leg->begin_m();
      controller_.reset();
    }
  }
  const geometry::Point place{measured.x_m, measured.y_m};
  arc_m_ = leg->nearest_m(place, std::max(leg->begin_m(), arc_m_ - kBehind_m),
                          std::min(leg->end_m(), arc_m_ + kBefore_m));
  deviation_m_ = geometry::distance(place, leg->at(arc_m_).pose.position());
  speed_m_s_ = std::max(0.0, leg->sign() * measured.speed_m_s);
}

// Who stands with the steering turned elsewhere turns it first. To a controller that has to drive off at once
// it may be cheapest to stay: with the wrong lock each way leads away from the path, and there is no time to
// change it.
double PathFollower::turning_s(const VehicleState& measured) const {
  if (std::abs(measured.speed_m_s) > kStands_m_s) return 0.0;
  const double wanted =
      std::clamp(section().leg.at(arc_m_).lock_rad, -limits_.full_lock_rad, limits_.full_lock_rad);
  return std::max(0.0, std::abs(wanted - measured.lock_rad) - kSteers_rad) / limits_.lock_rate_rad_s;
}

void PathFollower::fill_reference(const VehicleState& measured, double time_s, const Clearance& clearance) {
  const auto& [leg, plan] = section();
  const double turning = turning_s(measured);
  Progress progress{arc_m_, turning > 0.0 ? 0.0 : speed_m_s_, time_s};
  const Clearance held{clearance.permitted_m - settings_.halt_before_m, clearance.gates};
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    const double in_s = kControlStep_s * static_cast<double>(k);
    if (in_s <= turning) {
      progress.time_s = time_s + in_s;
    } else {
      progress = plan.advance(progress, kControlStep_s, held);
    }
    const LegPoint point = leg.at(progress.arc_m);
    reference_[k].state = {point.pose.x_m, point.pose.y_m, point.pose.heading_rad,
                           leg.sign() * progress.speed_m_s, point.lock_rad};
    reference_[k].area = area_at(progress.arc_m);
  }
}

// What the drives cannot do any more, a controller takes for a reason to stand. Measured speeds of who stands
// are not all small: it is places that count.
bool PathFollower::stalled() {
  const double ahead = section().leg.sign() * reference_.back().state.speed_m_s;
  const bool stands = std::abs(arc_m_ - stood_at_m_) <= kMoved_m && ahead > 2.0 * settings_.arrived_m_s;
  standing_s_ = stands ? standing_s_ + kControlStep_s : 0.0;
  if (!stands) stood_at_m_ = arc_m_;
  return standing_s_ > settings_.stalled_s;
}

DriveCommand PathFollower::step(const VehicleState& measured, double time_s, const Clearance& clearance) {
  if (lost_ || !finite(measured)) return {0.0, 0.0};
  find_place(measured);
  lost_ = deviation_m_ > settings_.lost_m;
  if (lost_ || arrived_) return {0.0, measured.lock_rad};
  fill_reference(measured, time_s, clearance);
  lost_ = stalled();
  if (lost_) return {0.0, measured.lock_rad};
  prediction_ = controller_.solve(measured, reference_);
  const double speed = measured.speed_m_s + ahead_s(limits_.speed_lag_s) * prediction_.acceleration_m_s2;
  const double lock = measured.lock_rad + ahead_s(limits_.lock_lag_s) * prediction_.lock_rate_rad_s;
  return {std::clamp(speed, -limits_.top_speed_m_s, limits_.top_speed_m_s),
          std::clamp(lock, -limits_.full_lock_rad, limits_.full_lock_rad)};
}

std::optional<double> PathFollower::expected_s(double arc_m, double time_s,
                                               const Clearance& clearance) const {
  if (arc_m <= arc_m_) return time_s;
  if (lost_ || arc_m > clearance.permitted_m) return std::nullopt;
  Progress progress{arc_m_, speed_m_s_, time_s};
  for (std::size_t k = at_; k < sections_.size(); ++k) {
    const auto& [leg, plan] = sections_[k];
    if (k > at_) progress = {leg.begin_m(), 0.0, progress.time_s + kTurnRound_s};
    const double wanted_m = std::min(arc_m, leg.end_m()) - settings_.arrived_m;
    while (progress.arc_m < wanted_m && progress.time_s < time_s + kLongest_s) {
      const Progress next = plan.advance(progress, kControlStep_s, clearance);
      if (next.arc_m <= progress.arc_m && next.speed_m_s <= 0.0 && progress.speed_m_s <= 0.0) break;
      progress = next;
    }
    if (arc_m <= leg.end_m())
      return progress.arc_m >= wanted_m ? std::optional(progress.time_s) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace stepwright::fleet
