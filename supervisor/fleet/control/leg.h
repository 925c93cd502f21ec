#pragma once

// A part of a path without a change of direction, to look up places by the length of way. A value; any thread
// may read.
//
//   const auto legs = split_into_legs(path, limits.wheelbase_m);
//   const LegPoint point = legs[0].at(3.2);

#include <cstddef>
#include <vector>

#include "supervisor/geometry/path.h"

namespace stepwright::fleet {

struct LegPoint {
  geometry::Pose pose;
  double lock_rad = 0.0;  // steering with which a vehicle stays on the leg
};

class Leg {
 public:
  // Requires two poses at least, of one direction; heading turns by less than half a turn from pose to pose.
  Leg(std::vector<geometry::PathPose> poses, double wheelbase_m);

  double begin_m() const { return points_.front().arc_m; }  // arc lengths of the whole path
  double end_m() const { return points_.back().arc_m; }
  double sign() const { return reverse_ ? -1.0 : 1.0; }  // of the speed
  // Arc lengths beyond the leg are taken to its ends. Headings are continuous along the leg.
  LegPoint at(double arc_m) const;
  // 1/m, the sharpest between the two arc lengths.
  double sharpest_1_m(double from_m, double to_m) const;
  // Arc length of the point nearest to `place`, looked for between the two.
  double nearest_m(geometry::Point place, double from_m, double to_m) const;

 private:
  struct Sample {
    geometry::Pose pose;
    double arc_m = 0.0;
    double curvature_1_m = 0.0;  // of the steering, from here to the next
  };
  std::size_t index_at(double arc_m) const;

  std::vector<Sample> points_;
  double wheelbase_m_;
  bool reverse_;
};

// Poses that do not move are left out; a path that goes nowhere has no legs.
std::vector<Leg> split_into_legs(const geometry::Path& path, double wheelbase_m);

}  // namespace stepwright::fleet
