#pragma once

// Paths of straight lines and arcs, for tests.

#include <cmath>

#include "supervisor/geometry/path.h"

namespace stepwright::fleet {

class MadePath {
 public:
  explicit MadePath(geometry::Pose start, geometry::Travel travel = geometry::Travel::Forward) {
    path_.push_back({start, 0.0, travel});
  }

  // `curvature_1_m` of the steering: positive turns left when driving forward.
  MadePath& drive(double length_m, double curvature_1_m = 0.0,
                  geometry::Travel travel = geometry::Travel::Forward) {
    constexpr double kStep_m = 0.05;
    const auto steps = static_cast<int>(std::lround(length_m / kStep_m));
    const double way = (travel == geometry::Travel::Forward ? 1.0 : -1.0) * length_m / steps;
    for (int k = 0; k < steps; ++k) {
      geometry::PathPose next = path_.back();
      const double middle = next.pose.heading_rad + 0.5 * way * curvature_1_m;
      next.pose.x_m += way * std::cos(middle);
      next.pose.y_m += way * std::sin(middle);
      next.pose.heading_rad += way * curvature_1_m;
      next.arc_m += length_m / steps;
      next.travel = travel;
      path_.push_back(next);
    }
    return *this;
  }

  const geometry::Path& path() const { return path_; }

 private:
  geometry::Path path_;
};

}  // namespace stepwright::fleet
