#include "supervisor/fleet/traffic/route.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "supervisor/fleet/control/leg.h"
#include "supervisor/fleet/control/speed_plan.h"
#include "supervisor/fleet/lattice/heading.h"

namespace stepwright::fleet {

namespace {

constexpr double kTick_s = 0.1;
constexpr double kTurnRound_s = 1.0;  // at a change of direction, with the steering
constexpr double kNear_m = 0.04;      // the end of a leg, where a vehicle has arrived
constexpr double kLongest_s = 24.0 * 3600.0;

using geometry::PathPose;

double seconds(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

// Times along one leg, appended as (arc, time).
double drive_leg(const Leg& leg, const DriveLimits& limits, double begin_s,
                 std::vector<std::pair<double, double>>& samples) {
  const SpeedPlan plan(leg, limits);
  Progress at{.arc_m = leg.begin_m(), .speed_m_s = 0.0, .time_s = begin_s};
  samples.emplace_back(at.arc_m, at.time_s);
  while (at.arc_m < leg.end_m() - kNear_m && at.time_s < begin_s + kLongest_s) {
    at = plan.advance(at, kTick_s, {});
    samples.emplace_back(at.arc_m, at.time_s);
  }
  samples.emplace_back(leg.end_m(), at.time_s);
  return at.time_s;
}

}  // namespace

Pace::Pace(const geometry::Path& path, std::span<const double> driving_s, std::span<const Stop> stops) {
  points_.reserve(path.size() + stops.size());
  double stood_s = 0.0;
  std::size_t stop = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    points_.push_back({path[k].arc_m, driving_s[k] + stood_s});
    for (; stop < stops.size() && stops[stop].pose <= k; ++stop) {
      stood_s += seconds(stops[stop].service);
      points_.push_back({path[k].arc_m, driving_s[k] + stood_s});
    }
  }
}

double Pace::time_s(double arc_m, bool behind) const {
  const auto after = behind ? std::ranges::upper_bound(points_, arc_m, {}, &Point::arc_m)
                            : std::ranges::lower_bound(points_, arc_m, {}, &Point::arc_m);
  if (after == points_.begin()) return points_.front().time_s;
  const Point& a = *(after - 1);
  if (after == points_.end() || after->arc_m <= a.arc_m) return a.time_s;
  return a.time_s + (after->time_s - a.time_s) * (arc_m - a.arc_m) / (after->arc_m - a.arc_m);
}

double Pace::arc_m(double time_s) const {
  const auto after = std::ranges::upper_bound(points_, time_s, {}, &Point::time_s);
  if (after == points_.begin()) return points_.front().arc_m;
  if (after == points_.end()) return points_.back().arc_m;
  const Point& a = *(after - 1);
  return a.arc_m + (after->arc_m - a.arc_m) * (time_s - a.time_s) / (after->time_s - a.time_s);
}

std::vector<double> driving_times_s(const geometry::Path& path, const DriveLimits& limits) {
  std::vector<std::pair<double, double>> samples;
  double now_s = 0.0;
  for (const Leg& leg : split_into_legs(path, limits.wheelbase_m)) {
    now_s = drive_leg(leg, limits, samples.empty() ? 0.0 : now_s + kTurnRound_s, samples);
  }
  std::vector<double> times(path.size(), 0.0);
  std::size_t at = 0;
  for (std::size_t k = 0; k < path.size() && !samples.empty(); ++k) {
    while (at + 1 < samples.size() && samples[at + 1].first < path[k].arc_m) ++at;
    const auto& [from_m, from_s] = samples[at];
    const auto& [to_m, to_s] = samples[std::min(at + 1, samples.size() - 1)];
    const double part =
        to_m > from_m ? std::clamp((path[k].arc_m - from_m) / (to_m - from_m), 0.0, 1.0) : 0.0;
    times[k] = from_s + part * (to_s - from_s);
  }
  return times;
}

result::Result<Route> make_route(VehicleMission mission, std::vector<double> driving_s) {
  Route route;
  if (driving_s.size() != mission.path.size()) {
    return result::fail(
        "F1001", {},
        fmt::format("{}: {} times for {} poses", mission.vehicle, driving_s.size(), mission.path.size()));
  }
  const auto& visits = mission.grown.visits;
  assert(std::ranges::is_sorted(visits, {}, &Visit::exit_m));
  const double end_m = mission.path.back().arc_m;
  bool together = false;  // with the polygon before
  for (std::size_t k = 0; k < visits.size(); ++k) {
    const double begin_m = k == 0 ? mission.path.front().arc_m : visits[k - 1].exit_m;
    const bool last = k + 1 == visits.size();
    route.needed_m.push_back(together ? route.needed_m.back() : begin_m);
    route.left_m.push_back(last ? end_m : std::min(end_m, visits[k].exit_m + kLeft_m));
    together = k > 0 && visits[k].exit_m - begin_m < kLeft_m + kHalt_m;
  }
  route.pace = Pace(mission.path, driving_s, mission.stops);
  route.driving_s = std::move(driving_s);
  for (std::size_t k = 0; k < visits.size(); ++k) {
    route.needed_s.push_back(route.pace.time_s(route.needed_m[k]));
    route.left_s.push_back(route.pace.time_s(route.left_m[k], true));
  }
  route.mission = std::move(mission);
  return route;
}

bool meets_any(const geometry::ConvexPolygon& polygon, std::span<const geometry::ConvexPolygon> places) {
  return std::ranges::any_of(places, [&](const auto& place) { return overlaps(polygon, place); });
}

// The next one takes those with it that are needed together with it anyway.
void pass_in_one_go(Route& route, std::uint32_t from, std::span<const geometry::ConvexPolygon> places) {
  const auto& polygons = route.mission.grown.envelope.polygons;
  for (std::uint32_t k = from; k + 1 < route.polygons(); ++k) {
    const double apart_m = route.needed_m[k + 1];
    if (apart_m == route.needed_m[k] || !meets_any(polygons[k].area, places)) continue;
    for (std::uint32_t i = k + 1; i < route.polygons() && route.needed_m[i] == apart_m; ++i) {
      route.needed_m[i] = route.needed_m[k];
      route.needed_s[i] = route.needed_s[k];
    }
  }
}

bool on_lattice(const geometry::Pose& pose, double resolution_m) {
  const auto at_vertex = [&](double value) {
    const double steps = value / resolution_m;
    return std::abs(steps - std::round(steps)) < 1e-6;
  };
  return at_vertex(pose.x_m) && at_vertex(pose.y_m) &&
         std::cos(pose.heading_rad - heading_rad(nearest_heading(pose.heading_rad))) > 1.0 - 1e-12;
}

std::uint32_t polygon_at(const Route& route, std::uint32_t first, double arc_m) {
  const auto& visits = route.mission.grown.visits;
  while (first + 1 < visits.size() && visits[first].exit_m < arc_m) ++first;
  return first;
}

namespace {

// Times of the spliced path: what was driven so far, then the continuation.
std::vector<double> spliced_times(const Route& old, std::size_t from, std::size_t branch,
                                  const Route& continuation) {
  std::vector<double> times;
  times.reserve(branch - from + continuation.driving_s.size());
  for (std::size_t k = from; k <= branch; ++k) times.push_back(old.driving_s[k] - old.driving_s[from]);
  const double offset_s = times.back() - continuation.driving_s.front();
  for (std::size_t k = 1; k < continuation.driving_s.size(); ++k)
    times.push_back(offset_s + continuation.driving_s[k]);
  return times;
}

// How far past the branch the polygon goes on to hold the vehicle.
void extend(Visit& visit, const geometry::ConvexPolygon& area, const VehicleMission& mission) {
  const auto inside = [&](std::size_t pose) {
    return area.contains(footprint_at(mission.path[pose].pose, mission.model.footprint()), 1e-9);
  };
  while (visit.last_pose + 1 < mission.path.size() && inside(visit.last_pose + 1)) ++visit.last_pose;
  visit.exit_m = mission.path[visit.last_pose].arc_m;
}

}  // namespace

result::Result<Route> splice(const Route& old, std::uint32_t first, std::size_t branch,
                             const Route& continuation) {
  const VehicleMission& before = old.mission;
  const double branch_m = before.path[branch].arc_m;
  const std::uint32_t last = polygon_at(old, first, branch_m);
  const std::size_t from = before.grown.visits[first].first_pose;
  if (before.grown.visits[last].exit_m < branch_m || branch < from)
    return result::fail("F1002", {}, before.vehicle + ": the place of the branch is in none of its polygons");
  VehicleMission made;
  made.vehicle = before.vehicle;
  made.model = before.model;
  made.speed = before.speed;
  made.path.assign(before.path.begin() + static_cast<std::ptrdiff_t>(from),
                   before.path.begin() + static_cast<std::ptrdiff_t>(branch) + 1);
  const double offset_m = branch_m - continuation.mission.path.front().arc_m;
  const std::size_t offset = branch - from;
  for (std::size_t k = 1; k < continuation.mission.path.size(); ++k) {
    made.path.push_back(continuation.mission.path[k]);
    made.path.back().arc_m += offset_m;
  }
  // A vehicle that stands at the end of its path has not yet said how it leaves it.
  if (made.path.size() > 1 && offset == 0) made.path.front().travel = made.path[1].travel;
  made.grown.envelope.vehicle = before.vehicle;
  for (const Stop& stop : before.stops) {
    if (stop.pose < from || stop.pose > branch || !moves_load(stop.kind)) continue;
    made.stops.push_back(stop);
    made.stops.back().pose -= from;
  }
  for (std::uint32_t k = first; k <= last; ++k) {
    Visit visit = before.grown.visits[k];
    visit.first_pose = std::max(visit.first_pose, from) - from;
    visit.last_pose = std::min(visit.last_pose, branch) - from;
    visit.entry_m = made.path[visit.first_pose].arc_m;
    visit.exit_m = made.path[visit.last_pose].arc_m;
    if (k == last) extend(visit, before.grown.envelope.polygons[k].area, made);
    made.grown.envelope.polygons.push_back(before.grown.envelope.polygons[k]);
    made.grown.visits.push_back(visit);
  }
  const double held_to_m = made.grown.visits.back().exit_m;
  for (std::uint32_t k = 0; k < continuation.polygons(); ++k) {
    Visit visit = continuation.mission.grown.visits[k];
    // Whom the polygon of the branch holds farther than this one does needs this one never. It would have to
    // be permitted while the vehicle cannot leave the one before.
    const bool last_of_all = k + 1 == continuation.polygons();
    if (visit.exit_m + offset_m <= held_to_m && !last_of_all) continue;
    visit.first_pose += offset;
    visit.last_pose += offset;
    visit.entry_m += offset_m;
    visit.exit_m += offset_m;
    made.grown.envelope.polygons.push_back(continuation.mission.grown.envelope.polygons[k]);
    made.grown.visits.push_back(visit);
  }
  for (Stop stop : continuation.mission.stops) {
    stop.pose += offset;
    stop.arc_m += offset_m;
    made.stops.push_back(std::move(stop));
  }
  return make_route(std::move(made), spliced_times(old, from, branch, continuation));
}

}  // namespace stepwright::fleet
