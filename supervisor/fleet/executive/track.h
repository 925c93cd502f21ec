#pragma once

// A way that a vehicle has driven, and where on it it stands. Values and pure functions.
//
//   track.arc_m = arc_near(track.path, track.arc_m, reading.pose);
//   if (distance_from_way(track, reading.pose) > kBesideWay_m) ...   // it stands elsewhere

#include "supervisor/geometry/path.h"

namespace stepwright::fleet {

struct Track {
  geometry::Path path;
  double arc_m = 0.0;
};

// A vehicle that stands farther from its way is not on it.
inline constexpr double kBesideWay_m = 0.4;

// Where on the path the vehicle stands, near a place of it.
double arc_near(const geometry::Path& path, double guess_m, const geometry::Pose& pose);
// How far from the place on the way at which it is thought to stand; without end where there is no such
// place.
double distance_from_way(const Track& track, const geometry::Pose& pose);

}  // namespace stepwright::fleet
