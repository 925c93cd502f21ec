#pragma once

// One vehicle's on-board side: follows its route from stop to stop within its permission, stands at stops.
// One thread at a time. The route stays where it is while the driver lives; after every new one comes
// renew().

#include <optional>
#include <set>
#include <string>

#include "supervisor/fleet/control/path_follower.h"
#include "supervisor/fleet/traffic/traffic.h"

namespace stepwright::bench::shift {

class Driver {
 public:
  Driver(const fleet::Route& route, const fleet::DriveLimits& limits, const geometry::Footprint& outline);

  void renew();
  // From a place on a new route, after the vehicle was out of order.
  void restart(double arc_m);
  // Its set points, and whether its brake is off.
  struct Drive {
    fleet::DriveCommand command;
    bool enable = false;
  };
  Drive step(const fleet::VehicleState& measured, const fleet::Permission& permission, double now_s,
             bool paused);

  // At a stop where it has to stand and has just come to rest: for how long is said by stand_for().
  const fleet::Stop* arrived_at() const { return arrived_at_; }
  void stand_for(double seconds, double now_s);
  // The stop at which it has stood long enough since the last step.
  std::optional<fleet::Stop> left_stop() const { return left_stop_; }

  fleet::VehicleLocation location() const;
  bool rests() const { return !follower_ && !standing_until_s_; }
  bool stands() const { return standing_until_s_.has_value(); }
  bool lost() const { return follower_ && follower_->lost(); }
  bool waits() const { return waits_; }  // for its permission
  // Whether it would still wait with this one, which may be newer than the one of its last step.
  bool waits_for_more_than(const fleet::Permission& permission) const;
  double deviation_m() const { return follower_ ? follower_->deviation_m() : 0.0; }
  std::uint64_t control_steps() const { return control_steps_; }

 private:
  void next_part();
  const fleet::Stop* next_stop() const;

  const fleet::Route& route_;
  fleet::DriveLimits limits_;
  geometry::Footprint outline_;
  std::optional<fleet::PathFollower> follower_;
  double target_m_ = 0.0;
  double arc_m_ = 0.0;
  double speed_m_s_ = 0.0;
  std::optional<double> standing_until_s_;
  std::set<std::string> served_;
  const fleet::Stop* arrived_at_ = nullptr;
  std::optional<fleet::Stop> left_stop_;
  std::optional<fleet::Stop> standing_at_;
  bool waits_ = false;
  std::uint64_t control_steps_ = 0;
};

}  // namespace stepwright::bench::shift
