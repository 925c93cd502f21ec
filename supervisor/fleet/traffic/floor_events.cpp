#include "supervisor/fleet/traffic/floor_events.h"

#include <algorithm>
#include <utility>

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

constexpr double kBefore_m = 0.05;  // of the place where the outline with its margin meets the obstacle
// A dead vehicle's surroundings that nobody drives into, so that it has room to begin to drive again.
constexpr double kAround_m = 0.15;
constexpr double kAlong_m = 0.75;
// Beyond the branch: more than where a follower halts before the place that it may not pass.
constexpr double kBranch_m = 0.35;
constexpr double kDriveOn_m = 1.2;  // how far it comes before its new way begins

}  // namespace

std::vector<Waypoint> FloorEvents::stops_behind(std::uint32_t vehicle, double arc_m) const {
  const VehicleMission& mission = traffic_.route(vehicle).mission;
  std::vector<Waypoint> stops;
  for (const Stop& stop : mission.stops)
    if (stop.arc_m > arc_m + 1e-6) stops.push_back({mission.path[stop.pose].pose, stop});
  return stops;
}

std::optional<double> FloorEvents::first_blocked_m(std::uint32_t vehicle) const {
  const geometry::Path& path = traffic_.route(vehicle).mission.path;
  const auto from = std::ranges::lower_bound(path, traffic_.arc_m(vehicle), {}, &geometry::PathPose::arc_m);
  const auto hit = std::find_if(
      from, path.end(), [&](const geometry::PathPose& at) { return planner_.meets_blocked(at.pose); });
  return hit == path.end() ? std::nullopt : std::optional(hit->arc_m);
}

// First nobody goes farther than he may, then one after the other is planned for.
std::vector<Detour> FloorEvents::detour_all(milliseconds now) {
  std::vector<std::uint32_t> concerned;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (traffic_.removed(v) || traffic_.rests(v)) continue;
    const auto blocked_m = first_blocked_m(v);
    if (!blocked_m) continue;
    traffic_.hold(v, *blocked_m - kBefore_m);
    concerned.push_back(v);
  }
  std::vector<Detour> detours;
  for (const std::uint32_t v : concerned) detours.push_back(detour(v, now));
  return detours;
}

Detour FloorEvents::detour(std::uint32_t vehicle, milliseconds now) {
  Detour made{.vehicle = vehicle, .kind = DetourKind::Waits, .given_up = {}, .why = {}};
  const auto branch = traffic_.branch(vehicle);
  if (!branch) {
    made.why = result::Diagnostics{
        {"F1002", result::Severity::Error, {}, "it stands too near to take another way", {}}};
    return made;
  }
  const std::vector<Waypoint> stops = stops_behind(vehicle, branch->arc_m);
  const auto attempt = [&](std::span<const Waypoint> through) {
    auto route = planner_.plan(vehicle, branch->place, through);
    if (!route) {
      made.why = std::move(route.error());
      return false;
    }
    auto change = traffic_.reroute(vehicle, *branch, *route, now);
    if (!change) made.why = std::move(change.error());
    return change.has_value();
  };
  if (attempt(stops)) {
    made.kind = DetourKind::Rerouted;
    made.why.clear();
  } else if (stops.size() > 1 && attempt(std::span(stops).last(1))) {
    made.kind = DetourKind::SentHome;
    for (const Waypoint& stop : std::span(stops).first(stops.size() - 1)) made.given_up.push_back(stop.stop);
  } else if (const auto blocked_m = first_blocked_m(vehicle)) {
    // It does not drive on to where it could not branch off any more.
    traffic_.hold(vehicle, std::min(*blocked_m - kBefore_m, branch->arc_m + kBranch_m));
  }
  return made;
}

std::vector<Detour> FloorEvents::release_free() {
  std::vector<Detour> released;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (!traffic_.held(v) || traffic_.removed(v)) continue;
    if (const auto blocked_m = first_blocked_m(v)) {
      traffic_.hold(v, *blocked_m - kBefore_m);
    } else {
      traffic_.release(v);
      released.push_back({.vehicle = v, .kind = DetourKind::DrivesOn, .given_up = {}, .why = {}});
    }
  }
  return released;
}

// Where vehicles that are held may be, as blocked places.
std::vector<std::uint32_t> FloorEvents::block_held() {
  std::vector<std::uint32_t> places;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (!traffic_.held(v) || traffic_.removed(v)) continue;
    const auto& polygons = traffic_.route(v).mission.grown.envelope.polygons;
    for (std::uint32_t k = traffic_.first(v); k < traffic_.granted(v); ++k)
      places.push_back(planner_.block(polygons[k].area));
  }
  return places;
}

Blockage FloorEvents::block(const geometry::ConvexPolygon& area, milliseconds now) {
  Blockage blockage{.number = planner_.block(area), .detours = {}};
  blockage.detours = detour_all(now);
  return blockage;
}

std::vector<Detour> FloorEvents::unblock(std::uint32_t number) {
  planner_.unblock(number);
  return release_free();
}

std::vector<Detour> FloorEvents::retry(milliseconds now) {
  std::vector<Detour> detours;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (!traffic_.held(v) || traffic_.removed(v)) continue;
    Detour made = detour(v, now);
    if (made.kind != DetourKind::Waits) detours.push_back(std::move(made));
  }
  return detours;
}

std::vector<Detour> FloorEvents::died(std::uint32_t vehicle, const geometry::Pose& at, milliseconds now) {
  geometry::Footprint outline = traffic_.route(vehicle).mission.model.footprint();
  outline.front_m += kAlong_m;
  outline.rear_m += kAlong_m;
  outline.half_width_m += kAround_m;
  traffic_.remove(vehicle);
  dead_[vehicle] = planner_.block(footprint_at(at, outline));
  return detour_all(now);
}

result::Result<std::vector<Detour>> FloorEvents::came_back(std::uint32_t vehicle, double here_m, bool home,
                                                           milliseconds now) {
  const geometry::Path& path = traffic_.route(vehicle).mission.path;
  std::vector<Waypoint> stops = stops_behind(vehicle, here_m);
  if (home && stops.size() > 1) stops.erase(stops.begin(), stops.end() - 1);
  const double next_m = stops.empty() ? path.back().arc_m : stops.front().stop.arc_m;
  const double wanted_m = std::min(here_m + kDriveOn_m, next_m);
  const auto from = std::ranges::lower_bound(path, here_m, {}, &geometry::PathPose::arc_m);
  auto to = std::ranges::lower_bound(path, wanted_m - 1e-6, {}, &geometry::PathPose::arc_m);
  while (to + 1 < path.end() && !on_lattice(to->pose, planner_.resolution_m())) ++to;
  const std::uint32_t number = dead_.at(vehicle);
  const geometry::ConvexPolygon area = planner_.blocked_area(number);
  planner_.unblock(number);
  const auto attempt = [&] {
    auto route = from == path.end() || from >= to ? planner_.plan(vehicle, path.back().pose, stops)
                                                  : planner_.plan_from(vehicle, {from, to + 1}, stops);
    return route ? traffic_.restore(vehicle, *std::move(route), now)
                 : result::Result<Change>(tl::unexpected(route.error()));
  };
  auto change = attempt();
  if (!change) {
    // Who is held waits for this one, perhaps right in its way: then it leaves them where they stand.
    const std::vector<std::uint32_t> places = block_held();
    if (!places.empty() && attempt()) change = Change{};
    for (const std::uint32_t place : places) planner_.unblock(place);
  }
  if (!change) {
    dead_[vehicle] = planner_.block(area);
    return result::forward(change);
  }
  dead_.erase(vehicle);
  return release_free();
}

}  // namespace stepwright::fleet
