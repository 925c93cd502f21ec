#include "supervisor/fleet/executive/track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stepwright::fleet {
namespace {

constexpr double kSearch_m = 6.0;  // of the way, around where it is thought to be

}  // namespace

double arc_near(const geometry::Path& path, double guess_m, const geometry::Pose& pose) {
  double best_m = guess_m;
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::PathPose& at : path) {
    if (std::abs(at.arc_m - guess_m) > kSearch_m) continue;
    // A place that is passed twice: the one with the vehicle's heading, then the one that is expected.
    const double turned =
        std::abs(std::remainder(at.pose.heading_rad - pose.heading_rad, 2.0 * std::numbers::pi));
    const double off = geometry::distance(at.pose.position(), pose.position()) + turned +
                       0.02 * std::abs(at.arc_m - guess_m);
    if (off >= least) continue;
    least = off;
    best_m = at.arc_m;
  }
  return best_m;
}

double distance_from_way(const Track& track, const geometry::Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::PathPose& at : track.path) {
    if (std::abs(at.arc_m - track.arc_m) < 0.1)
      least = std::min(least, geometry::distance(at.pose.position(), pose.position()));
  }
  return least;
}

}  // namespace stepwright::fleet
