#pragma once

// A mission as traffic sees it: at which length of way each polygon must be free, at which it is left, and
// how long the way takes a vehicle that nobody holds up.
//
// A value; any thread may read. Polygon k is needed from needed_m[k] on, where the polygon before it ends to
// hold the vehicle, and left at left_m[k], a little behind where the next one begins to be needed. A polygon
// that takes the vehicle less than kLeft_m + kHalt_m further is needed together with the next one: so a
// vehicle that stands before a polygon it may not enter yet has left all polygons but one. Without that, two
// vehicles could each wait for a polygon that the other one cannot leave.
//
//   auto route = make_route(plan.missions[0], limits);
//   if (!route) print(to_string(route.error()));
//   route->needed_m[3];

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/control/drive_limits.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

// A vehicle has left a polygon when it is so far behind the place where it could first have done.
inline constexpr double kLeft_m = 0.1;
// Where a vehicle stands that may not go on, before the place: at most.
inline constexpr double kHalt_m = 0.7;

// From a way to a time and back, without others in the way; stops are stood at in full.
class Pace {
 public:
  Pace() = default;
  // Standing at `stops` of the mission comes on top of driving. `driving_s[k]` is the time at pose k.
  Pace(const geometry::Path& path, std::span<const double> driving_s, std::span<const Stop> stops);

  // Just before a stop at this place; just behind it with `behind`.
  double time_s(double arc_m, bool behind = false) const;
  // Where the vehicle is then; at a stop while it stands there.
  double arc_m(double time_s) const;

 private:
  struct Point {
    double arc_m = 0.0;
    double time_s = 0.0;
  };
  std::vector<Point> points_;  // neither falls
};

struct Route {
  VehicleMission mission;
  Pace pace;
  std::vector<double> driving_s;  // by pose, without standing
  std::vector<double> needed_m;   // by polygon
  std::vector<double> left_m;
  // By polygon, seconds from the begin of the path.
  std::vector<double> needed_s;
  std::vector<double> left_s;

  std::uint32_t polygons() const { return static_cast<std::uint32_t>(needed_m.size()); }
  double end_m() const { return mission.path.back().arc_m; }
};

// Seconds from the first pose to each: curves, accelerations, at rest at both ends and where the direction
// changes. Requires a path that `PathFollower` takes.
std::vector<double> driving_times_s(const geometry::Path& path, const DriveLimits& limits);

// F1001: there is not one time for each pose.
[[nodiscard]] result::Result<Route> make_route(VehicleMission mission, std::vector<double> driving_s);

// The route up to pose `branch` of `old`, from polygon `first` on, and from there the continuation, whose
// path begins at that pose with any length of way. F1001 as above; F1002: the pose is not within a polygon
// from `first` on.
[[nodiscard]] result::Result<Route> splice(const Route& old, std::uint32_t first, std::size_t branch,
                                           const Route& continuation);

// Polygons from `from` on that overlap one of the places are needed together with the next one: nobody has to
// wait there, who waits does so before the place and is past it without asking again.
void pass_in_one_go(Route& route, std::uint32_t from, std::span<const geometry::ConvexPolygon> places);

// Whether one of the places overlaps the polygon.
bool meets_any(const geometry::ConvexPolygon& polygon, std::span<const geometry::ConvexPolygon> places);

// Whether a path can be planned from the pose exactly.
bool on_lattice(const geometry::Pose& pose, double resolution_m);

// The first polygon from `first` on that still holds the vehicle at this place.
std::uint32_t polygon_at(const Route& route, std::uint32_t first, double arc_m);

}  // namespace stepwright::fleet
