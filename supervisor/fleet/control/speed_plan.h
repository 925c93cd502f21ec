#pragma once

// Speed plan of a vehicle for a leg: top speed, curves, and that it can stop at the leg's end. A value; any
// thread may read.
//
//   const SpeedPlan plan(leg, limits);
//   Progress now{.arc_m = 2.0, .speed_m_s = 0.8};
//   now = plan.advance(now, 0.1, clearance);

#include <limits>
#include <span>
#include <vector>

#include "supervisor/fleet/control/drive_limits.h"
#include "supervisor/fleet/control/leg.h"

namespace stepwright::fleet {

// Along the path; the speed is never negative here.
struct Progress {
  double arc_m = 0.0;
  double speed_m_s = 0.0;
  double time_s = 0.0;
};

// A place that is not to be passed before a time: the entry of a polygon in a schedule.
struct Gate {
  double arc_m = 0.0;
  double not_before_s = 0.0;
};

// Permission of a vehicle at present. Behind `permitted_m` it has no precedence yet.
struct Clearance {
  double permitted_m = std::numeric_limits<double>::infinity();
  std::span<const Gate> gates{};  // in the order of the way
};

class SpeedPlan {
 public:
  SpeedPlan(const Leg& leg, const DriveLimits& limits);

  // m/s; 0 at the end of the leg.
  double ceiling_m_s(double arc_m) const;
  // As fast as ceilings, clearance and the drive allow, for `seconds`. A gate that is reached too early is
  // approached slowly rather than waited at.
  Progress advance(const Progress& from, double seconds, const Clearance& clearance) const;

 private:
  double allowed_m_s(const Progress& at, const Clearance& clearance) const;

  DriveLimits limits_;
  double begin_m_;
  double end_m_;
  double step_m_;
  std::vector<double> ceiling_m_s_;  // every step_m_ from begin_m_ on
};

}  // namespace stepwright::fleet
