#include "supervisor/fleet/traffic/floor_events.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/fleet/traffic/no_order.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

constexpr double kBefore_m = 0.05;  // of the place where the outline with its margin meets the obstacle
// What is kept free beside a dead vehicle's outline with its margin, and before and behind it, where other
// ways lead past, so that it has room to begin to drive.
constexpr double kAround_m = 0.15;
constexpr double kAlong_m = 0.75;
// From its last answer until its brake holds it, and what that brake does at least.
constexpr double kUnseen_s = 0.2;
constexpr double kFails_safe_m_s2 = 3.0;
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

std::optional<double> FloorEvents::first_m(std::uint32_t vehicle, double from_m, Meets meets) const {
  const geometry::Path& path = traffic_.route(vehicle).mission.path;
  const auto from = std::ranges::lower_bound(path, from_m, {}, &geometry::PathPose::arc_m);
  const auto hit = std::find_if(from, path.end(),
                                [&](const geometry::PathPose& at) { return (planner_.*meets)(at.pose); });
  return hit == path.end() ? std::nullopt : std::optional(hit->arc_m);
}

std::optional<double> FloorEvents::first_blocked_m(std::uint32_t vehicle) const {
  return first_m(vehicle, traffic_.arc_m(vehicle), &RoutePlanner::meets_blocked);
}

std::vector<std::uint32_t> FloorEvents::hold_blocked() {
  std::vector<std::uint32_t> concerned;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (traffic_.removed(v) || traffic_.rests(v)) continue;
    const auto blocked_m = first_blocked_m(v);
    if (!blocked_m) continue;
    traffic_.hold(v, *blocked_m - kBefore_m);
    concerned.push_back(v);
  }
  return concerned;
}

std::vector<Detour> FloorEvents::detour_all(std::span<const std::uint32_t> vehicles, milliseconds now) {
  std::vector<Detour> detours;
  for (const std::uint32_t v : vehicles) detours.push_back(detour(v, now));
  return detours;
}

// Whose way leads through the room of a dead vehicle, or where one is held, takes another one if there is
// any.
void FloorEvents::leave_rooms(milliseconds now, std::vector<Detour>& detours) {
  if (dead_.empty() && held_.empty()) return;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (traffic_.removed(v) || traffic_.rests(v) || traffic_.held(v)) continue;
    const auto branch = traffic_.branch(v);
    if (!branch || !first_m(v, branch->arc_m, &RoutePlanner::meets_room)) continue;
    const auto route = planner_.plan(v, branch->place, stops_behind(v, branch->arc_m));
    const auto in_room = [&](const geometry::PathPose& at) { return planner_.meets_room(at.pose); };
    if (!route || std::ranges::any_of(route->mission.path, in_room)) continue;
    if (traffic_.reroute(v, *branch, *route, now))
      detours.push_back({.vehicle = v, .kind = DetourKind::Rerouted, .given_up = {}, .why = {}});
  }
}

// Else they would come nearer and nearer to one that may have to drive back, and wait for as long as it does.
void FloorEvents::mark_held(std::uint32_t vehicle) {
  const bool held = traffic_.held(vehicle) && !traffic_.removed(vehicle);
  const std::pair permitted(traffic_.first(vehicle), traffic_.granted(vehicle));
  const auto known = held_.find(vehicle);
  if (known != held_.end()) {
    if (held && known->second.permitted == permitted) return;
    for (const std::uint32_t place : known->second.places) planner_.unblock(place);
    held_.erase(known);
  }
  if (!held) return;
  Held& made = held_[vehicle];
  made.permitted = permitted;
  const auto& polygons = traffic_.route(vehicle).mission.grown.envelope.polygons;
  for (std::uint32_t k = permitted.first; k < permitted.second; ++k)
    made.places.push_back(planner_.avoid(vehicle, polygons[k].area));
}

Detour FloorEvents::detour(std::uint32_t vehicle, milliseconds now) {
  Detour made{.vehicle = vehicle, .kind = DetourKind::Waits, .given_up = {}, .why = {}};
  const auto branch = traffic_.branch(vehicle);
  if (!branch) {
    made.why = result::Diagnostics{
        {"F1002", result::Severity::Error, {}, "it stands too near to take another way", {}}};
    mark_held(vehicle);
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
  mark_held(vehicle);
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
      mark_held(v);
      released.push_back({.vehicle = v, .kind = DetourKind::DrivesOn, .given_up = {}, .why = {}});
    }
  }
  return released;
}

// Where vehicles may be that wait for a dead one to be gone, or for its room to be free, as blocked places.
std::vector<std::uint32_t> FloorEvents::block_waiting(std::uint32_t dead) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
    if (traffic_.removed(v) || !(traffic_.held(v) || traffic_.is_before_room(v, dead))) continue;
    const auto& polygons = traffic_.route(v).mission.grown.envelope.polygons;
    for (std::uint32_t k = traffic_.first(v); k < traffic_.granted(v); ++k)
      places.push_back(planner_.block(polygons[k].area));
  }
  return places;
}

Blockage FloorEvents::block(const geometry::ConvexPolygon& area, milliseconds now) {
  Blockage blockage{.number = planner_.block(area), .detours = {}};
  blockage.detours = detour_all(hold_blocked(), now);
  leave_rooms(now, blockage.detours);
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
  leave_rooms(now, detours);
  return detours;
}

std::vector<Detour> FloorEvents::died(std::uint32_t vehicle, const geometry::Pose& at, milliseconds now) {
  const VehicleMission& mission = traffic_.route(vehicle).mission;
  const auto here =
      std::ranges::lower_bound(mission.path, traffic_.arc_m(vehicle), {}, &geometry::PathPose::arc_m);
  const bool backwards = here != mission.path.end() && here->travel == geometry::Travel::Reverse;
  const double speed_m_s = std::abs(traffic_.speed_m_s(vehicle));
  const double unseen_m = speed_m_s * (kUnseen_s + speed_m_s / (2.0 * kFails_safe_m_s2));
  const auto outline = [&](double ahead_m, double behind_m, double beside_m) {
    geometry::Footprint longer = mission.model.footprint();
    longer.front_m += std::min(ahead_m, kAlong_m);
    longer.rear_m += std::min(behind_m, kAlong_m);
    longer.half_width_m += beside_m;
    return footprint_at(at, longer);
  };
  Dead dead{.number = 0,
            .outline = outline(backwards ? 0.0 : unseen_m, backwards ? unseen_m : 0.0, 0.0),
            .room = {.area = outline(kAlong_m, kAlong_m, kAround_m)}};
  traffic_.remove(vehicle, begin_of_way(vehicle, dead.room.area));
  mark_held(vehicle);
  dead.number = planner_.block(dead.outline, dead.room);
  dead_.insert_or_assign(vehicle, std::move(dead));
  const std::vector<std::uint32_t> held = hold_blocked();
  traffic_.clear_rooms(now);
  std::vector<Detour> detours = detour_all(held, now);
  leave_rooms(now, detours);
  return detours;
}

// The room, and what it needs on the first piece of its way. Cells are blocked as wholes.
geometry::ConvexPolygon FloorEvents::begin_of_way(std::uint32_t vehicle,
                                                  const geometry::ConvexPolygon& room) const {
  std::vector<geometry::Point> corners(room.corners().begin(), room.corners().end());
  const double here_m = traffic_.arc_m(vehicle);
  geometry::Footprint outline = traffic_.route(vehicle).mission.model.footprint();
  outline.front_m += kAround_m;
  outline.rear_m += kAround_m;
  outline.half_width_m += kAround_m;
  for (const geometry::PathPose& pose : first_piece(vehicle, here_m, stops_behind(vehicle, here_m))) {
    const auto taken = footprint_at(pose.pose, outline);
    corners.insert(corners.end(), taken.corners().begin(), taken.corners().end());
  }
  return geometry::ConvexPolygon::hull(corners).value_or(room);
}

// Along the way it was on, to where a new one can begin; no more than to its next stop.
std::span<const geometry::PathPose> FloorEvents::first_piece(std::uint32_t vehicle, double here_m,
                                                             std::span<const Waypoint> stops) const {
  const geometry::Path& path = traffic_.route(vehicle).mission.path;
  const double next_m = stops.empty() ? path.back().arc_m : stops.front().stop.arc_m;
  const double wanted_m = std::min(here_m + kDriveOn_m, next_m);
  const auto from = std::ranges::lower_bound(path, here_m, {}, &geometry::PathPose::arc_m);
  auto to = std::ranges::lower_bound(path, wanted_m - 1e-6, {}, &geometry::PathPose::arc_m);
  while (to + 1 < path.end() && !on_lattice(to->pose, planner_.resolution_m())) ++to;
  if (from == path.end() || from >= to) return {};
  return {from, to + 1};
}

result::Result<std::vector<Detour>> FloorEvents::came_back(std::uint32_t vehicle, double here_m, bool home,
                                                           milliseconds now) {
  const geometry::Path& path = traffic_.route(vehicle).mission.path;
  std::vector<Waypoint> stops = stops_behind(vehicle, here_m);
  if (home && stops.size() > 1) stops.erase(stops.begin(), stops.end() - 1);
  const std::span<const geometry::PathPose> begin = first_piece(vehicle, here_m, stops);
  Dead& dead = dead_.at(vehicle);
  planner_.unblock(dead.number);
  const auto attempt = [&] {
    auto route = begin.empty() ? planner_.plan(vehicle, path.back().pose, stops)
                               : planner_.plan_from(vehicle, {begin.begin(), begin.end()}, stops);
    return route ? traffic_.restore(vehicle, *std::move(route), now)
                 : result::Result<Change>(tl::unexpected(route.error()));
  };
  auto change = attempt();
  if (!change) {
    // Who waits for this one does so right in its way, perhaps: then it leaves them where they stand.
    const std::vector<std::uint32_t> places = block_waiting(vehicle);
    if (!places.empty() && attempt()) change = Change{};
    for (const std::uint32_t place : places) planner_.unblock(place);
  }
  if (!change) {
    // Whose ways lead through its room already drive them to their ends; there will be no more of them.
    dead.room.closed = dead.room.closed || change.error().front().code == kNoOrder;
    dead.number = planner_.block(dead.outline, dead.room);
    return result::forward(change);
  }
  dead_.erase(vehicle);
  return release_free();
}

}  // namespace stepwright::fleet
