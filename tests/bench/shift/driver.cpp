#include "tests/bench/shift/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stepwright::bench::shift {

namespace {

constexpr double kHere_m = 0.05;
constexpr double kStands_m_s = 0.03;
// Of the place up to which it may go: who stands so near to it stays there.
constexpr double kNear_m = 0.6;

std::string key_of(const fleet::Stop& stop) {
  return stop.goal + (stop.kind == fleet::StopKind::SetDown ? " set down" : " pick up");
}

fleet::FollowerSettings settings() {
  fleet::FollowerSettings made;
  made.halt_before_m = 0.3;
  made.stalled_s = 20.0;
  return made;
}

}  // namespace

Driver::Driver(const fleet::Route& route, const fleet::DriveLimits& limits,
               const geometry::Footprint& outline)
    : route_(route), limits_(limits), outline_(outline), arc_m_(route.mission.path.front().arc_m) {
  next_part();
}

const fleet::Stop* Driver::next_stop() const {
  for (const fleet::Stop& stop : route_.mission.stops) {
    if (stop.kind != fleet::StopKind::Park && stop.arc_m >= arc_m_ - kHere_m &&
        !served_.contains(key_of(stop)))
      return &stop;
  }
  return nullptr;
}

// Up to the next stop, or the end.
void Driver::next_part() {
  follower_.reset();
  arrived_at_ = nullptr;
  const fleet::Stop* stop = next_stop();
  target_m_ = stop != nullptr ? stop->arc_m : route_.end_m();
  if (target_m_ - arc_m_ <= 1e-3) {
    arrived_at_ = stop;
    return;
  }
  const geometry::Path& path = route_.mission.path;
  auto from = std::ranges::upper_bound(path, arc_m_, {}, &geometry::PathPose::arc_m);
  if (from != path.begin()) --from;
  const auto to = std::ranges::upper_bound(path, target_m_ + 1e-9, {}, &geometry::PathPose::arc_m);
  geometry::Path part(from, to);
  if (part.size() > 1) part.front().travel = part[1].travel;
  std::vector<fleet::PathArea> areas;
  const auto& grown = route_.mission.grown;
  for (std::size_t k = 0; k < grown.visits.size(); ++k) {
    if (grown.visits[k].exit_m < arc_m_ - 0.5 || grown.visits[k].entry_m > target_m_) continue;
    areas.push_back({grown.envelope.polygons[k].area, grown.visits[k].entry_m, grown.visits[k].exit_m});
  }
  auto follower = fleet::PathFollower::create(part, areas, limits_, outline_, settings());
  if (follower) {
    follower_.emplace(*std::move(follower));
  } else {
    arrived_at_ = stop;
  }
}

void Driver::renew() {
  if (!standing_until_s_) next_part();
}

void Driver::restart(double arc_m) {
  arc_m_ = arc_m;
  speed_m_s_ = 0.0;
  if (!standing_until_s_) next_part();
}

void Driver::stand_for(double seconds, double now_s) {
  standing_at_ = *arrived_at_;
  standing_until_s_ = now_s + seconds;
  arrived_at_ = nullptr;
}

fleet::VehicleLocation Driver::location() const {
  using std::chrono::milliseconds;
  const milliseconds until =
      standing_until_s_ ? milliseconds(std::llround(1e3 * *standing_until_s_)) : milliseconds(0);
  return {arc_m_, speed_m_s_, until};
}

bool Driver::waits_for_more_than(const fleet::Permission& permission) const {
  return permission.permitted_m - arc_m_ < kNear_m && permission.permitted_m < target_m_;
}

Driver::Drive Driver::step(const fleet::VehicleState& measured, const fleet::Permission& permission,
                           double now_s, bool paused) {
  left_stop_.reset();
  waits_ = false;
  if (standing_until_s_) {
    if (now_s < *standing_until_s_) return {{0.0, measured.lock_rad}, false};
    left_stop_ = standing_at_;
    served_.insert(key_of(*standing_at_));
    standing_until_s_.reset();
    next_part();
  }
  if (!follower_ || follower_->lost()) return {{0.0, measured.lock_rad}, false};
  speed_m_s_ = std::abs(measured.speed_m_s);
  const bool still = speed_m_s_ < kStands_m_s;
  if (paused) {
    // It stops on the spot and stays in its lane, as when its scanner sees somebody. How far it comes until
    // then has to be told: a new way would begin behind it.
    follower_->step(measured, now_s, {arc_m_, {}});
    arc_m_ = std::max(arc_m_, follower_->arc_m());
    return {{0.0, measured.lock_rad}, !still};
  }
  // The follower would say the same in more time.
  waits_ = still && waits_for_more_than(permission);
  if (waits_) return {{0.0, measured.lock_rad}, true};
  ++control_steps_;
  const auto gates = permission.gate ? std::span(&*permission.gate, 1) : std::span<const fleet::Gate>();
  // It need not keep its distance from a place behind the one where it stops anyway.
  const double permitted_m =
      permission.permitted_m < target_m_ ? permission.permitted_m : std::numeric_limits<double>::infinity();
  const fleet::DriveCommand command = follower_->step(measured, now_s, {permitted_m, gates});
  arc_m_ = std::max(arc_m_, follower_->arc_m());
  if (!follower_->arrived()) return {command, true};
  arc_m_ = target_m_;
  speed_m_s_ = 0.0;
  follower_.reset();
  arrived_at_ = next_stop();
  return {{0.0, measured.lock_rad}, false};
}

}  // namespace stepwright::bench::shift
