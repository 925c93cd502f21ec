#include "supervisor/fleet/traffic/route_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <thread>
#include <utility>

#include "supervisor/map/row_span.h"

namespace stepwright::fleet {

namespace {

using geometry::ConvexPolygon;
using geometry::Path;
using geometry::Pose;

constexpr std::uint32_t kNobody = 0xFFFFFFFF;
constexpr double kSamePlace_m = 0.01;

bool same_place(const Pose& a, const Pose& b) {
  return geometry::distance(a.position(), b.position()) < kSamePlace_m &&
         std::cos(a.heading_rad - b.heading_rad) > 0.9999;
}

std::size_t pose_at(const Path& path, double arc_m) {
  const auto at = std::ranges::lower_bound(path, arc_m, {}, &geometry::PathPose::arc_m);
  return at == path.end() ? path.size() - 1 : static_cast<std::size_t>(at - path.begin());
}

}  // namespace

VehicleModel with_margin(const RouteSettings& settings) {
  VehicleModel model = settings.vehicle;
  model.front_m += settings.margin_m;
  model.rear_m += settings.margin_m;
  model.width_m += 2.0 * settings.margin_m;
  return model;
}

result::Result<RoutePlanner> RoutePlanner::create(OccupancyGrid floor, const PrimitiveSet& primitives,
                                                  const HeuristicTable& table, std::vector<HomePlace> homes,
                                                  const RouteSettings& settings) {
  RoutePlanner made(std::move(floor), primitives, std::move(homes), settings);
  auto planner = PathPlanner::create(*made.floor_, made.planned_, primitives, table);
  if (!planner) return result::forward(planner);
  made.base_.emplace(*std::move(planner));
  return made;
}

RoutePlanner::RoutePlanner(OccupancyGrid floor, const PrimitiveSet& primitives, std::vector<HomePlace> homes,
                           const RouteSettings& settings)
    : floor_(std::make_unique<OccupancyGrid>(std::move(floor))),
      primitives_(&primitives),
      homes_(std::move(homes)),
      settings_(settings),
      planned_(with_margin(settings)) {}

std::uint32_t RoutePlanner::layer_of(std::uint32_t vehicle, const Pose& from, const Pose& to) const {
  // Ways that have nothing to do with the vehicle's home are the same for all vehicles.
  constexpr double kNear_m = 12.0;
  const geometry::Point home = homes_[vehicle].pose.position();
  const bool near =
      geometry::distance(home, from.position()) < kNear_m || same_place(homes_[vehicle].pose, to);
  const bool its_own =
      std::ranges::any_of(blocked_, [&](const auto& entry) { return entry.second.open_to == vehicle; });
  return near || its_own ? vehicle : kNobody;
}

RoutePlanner::Place RoutePlanner::place_of(const Pose& pose) const {
  const double step_m = primitives_->options().resolution_m;
  return {static_cast<int>(std::lround(pose.x_m / step_m)), static_cast<int>(std::lround(pose.y_m / step_m)),
          nearest_heading(pose.heading_rad)};
}

void RoutePlanner::prepare(std::span<const Pose> goals, unsigned threads) {
  if (!motions_) motions_ = std::make_unique<FreeMotions>(base_->free_motions(threads));
  std::vector<Pose> missing;
  std::set<Place> places;
  for (const Pose& goal : goals) {
    if (!costs_to_go_.contains(place_of(goal)) && places.insert(place_of(goal)).second)
      missing.push_back(goal);
  }
  std::vector<std::optional<CostToGo>> made(missing.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < missing.size(); k = next++)
      made[k] = base_->cost_to_go(*motions_, missing[k]);
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned k = 1; k < threads; ++k) helpers.emplace_back(work);
    work();
  }
  for (std::size_t k = 0; k < missing.size(); ++k) {
    if (made[k]) costs_to_go_.emplace(place_of(missing[k]), *std::move(made[k]));
  }
}

// Maps keep where their values are, so that what is found stays there while other threads add theirs.
const RoutePlanner::Layer& RoutePlanner::layer(const LayerKey& key) {
  const std::lock_guard lock(*kept_);
  const auto found = layers_.find(key);
  if (found != layers_.end()) return found->second;
  Layer made{std::make_unique<OccupancyGrid>(*floor_), nullptr};
  // With room for the polygon in which a vehicle rests for ever: nobody would get past it.
  geometry::Footprint closed = planned_.footprint();
  closed.front_m += settings_.tail_m + 4.0 * settings_.tail_growth_m;
  closed.rear_m += settings_.tail_m + 4.0 * settings_.tail_growth_m;
  for (std::uint32_t v = 0; v < homes_.size(); ++v)
    if (v != key.vehicle) fleet::block(*made.grid, footprint_at(homes_[v].pose, closed));
  for (const auto& [number, blocked] : blocked_) {
    if (const ConvexPolygon* area = blocked.closed_on(key)) fleet::block(*made.grid, *area);
  }
  made.planner = std::make_unique<PathPlanner>(base_->on(*made.grid));
  return layers_.emplace(key, std::move(made)).first->second;
}

// The last polygon holds the tail of the path alone.
std::vector<EnvelopePart> RoutePlanner::parts_from(const Path& path, std::size_t begin) const {
  EnvelopeOptions tight = settings_.envelope;
  tight.growth_m = settings_.tail_growth_m;
  tight.stretch_m = 2.0 * settings_.tail_m;
  const double tail_m = path.back().arc_m - settings_.tail_m;
  if (tail_m - path[begin].arc_m < kLeft_m + kHalt_m) return {{path.size() - 1, tight}};
  return {{pose_at(path, tail_m), settings_.envelope}, {path.size() - 1, tight}};
}

result::Result<Route> RoutePlanner::leg_along(const OccupancyGrid& grid, Path path) const {
  auto grown = grow_in_parts(grid, planned_.footprint(), {}, path, parts_from(path, 0));
  if (!grown) return result::forward(grown);
  VehicleMission mission;
  mission.model = planned_;
  mission.grown = *std::move(grown);
  std::vector<double> driving_s = driving_times_s(path, settings_.limits);
  mission.path = std::move(path);
  return make_route(std::move(mission), std::move(driving_s));
}

result::Result<const RoutePlanner::Leg*> RoutePlanner::leg(std::uint32_t vehicle, const Pose& from,
                                                           const Pose& to, bool last) {
  const std::uint32_t whose = layer_of(vehicle, from, to);
  auto clear = leg_on({whose, Rooms::None}, vehicle, from, to);
  const bool rooms =
      std::ranges::any_of(blocked_, [](const auto& entry) { return entry.second.room.has_value(); });
  if (clear || !rooms || (last && rests_in_room(to))) return clear;
  auto through = leg_on({whose, meets_room(from) ? Rooms::All : Rooms::NotClosed}, vehicle, from, to);
  return through ? through : clear;
}

result::Result<const RoutePlanner::Leg*> RoutePlanner::leg_on(const LayerKey& on, std::uint32_t vehicle,
                                                              const Pose& from, const Pose& to) {
  const LegKey key{on, place_of(from), place_of(to)};
  {
    const std::lock_guard lock(*kept_);
    if (const auto found = legs_.find(key); found != legs_.end()) return &found->second;
  }
  const Layer& floor = layer(on);
  if (enclosed(on, from, to)) {
    return result::fail("F0305", {},
                        fmt::format("what is blocked keeps {} from ({:.2f} m, {:.2f} m)",
                                    homes_[vehicle].vehicle, to.x_m, to.y_m));
  }
  PathAnswer answer = path(*floor.planner, from, to);
  if (!answer.path) {
    // Where not even a disc gets through that was found out in no time, and will be again.
    const std::lock_guard lock(*kept_);
    if (answer.expanded > 0) in_doubt_.insert(place_of(to));
    in_vain_ += answer.expanded > 0 ? 1 : 0;
    return tl::unexpected(std::move(answer.diagnostics));
  }
  auto route = leg_along(*floor.grid, std::move(answer.path->poses));
  if (!route) return result::forward(route);
  // Who came second has found the same.
  const std::lock_guard lock(*kept_);
  const auto [kept, is_new] = legs_.try_emplace(key, Leg{*std::move(route), changes_});
  paths_planned_ += is_new ? 1 : 0;
  return &kept->second;
}

// A search in vain looks at all of the floor, and who waits for a way asks again and again. After the first
// one, what is enclosed with the goal is looked at instead, once for each layer.
bool RoutePlanner::enclosed(const LayerKey& on, const Pose& from, const Pose& to) {
  constexpr std::size_t kFew = 40'000;
  const std::pair key(on, place_of(to));
  const PathPlanner& planner = *layer(on).planner;
  {
    const std::lock_guard lock(*kept_);
    if (!in_doubt_.contains(key.second)) return false;
    if (const auto known = approaches_.find(key); known != approaches_.end())
      return known->second && !known->second->hold(from);
  }
  auto found = planner.approaches(to, kFew);
  const std::lock_guard lock(*kept_);
  const auto& known = approaches_.try_emplace(key, std::move(found)).first->second;
  return known && !known->hold(from);
}

PathAnswer RoutePlanner::path(const PathPlanner& planner, const Pose& from, const Pose& to) const {
  const PathOptions options{.first_weight = settings_.path_weight, .last_weight = settings_.path_weight};
  const auto to_go = costs_to_go_.find(place_of(to));
  return to_go == costs_to_go_.end() ? planner.plan(from, to, options)
                                     : planner.plan_guided(from, to, options, to_go->second);
}

result::Result<Route> RoutePlanner::stand(std::uint32_t vehicle, const Pose& at) {
  Path path{{at, 0.0, geometry::Travel::Forward}};
  auto route = leg_along(*layer({vehicle, Rooms::All}).grid, std::move(path));
  if (route) route->mission.vehicle = homes_[vehicle].vehicle;
  return route;
}

result::Result<Route> RoutePlanner::plan(std::uint32_t vehicle, const Pose& from,
                                         std::span<const Waypoint> stops) {
  return plan_behind(vehicle, std::nullopt, from, stops);
}

result::Result<Route> RoutePlanner::plan_from(std::uint32_t vehicle, const Path& begin,
                                              std::span<const Waypoint> stops) {
  auto first = tight_leg(*layer({vehicle, Rooms::All}).grid, begin);
  if (!first) return first;
  return plan_behind(vehicle, *std::move(first), begin.back().pose, stops);
}

result::Result<Route> RoutePlanner::plan_behind(std::uint32_t vehicle, std::optional<Route> whole, Pose at,
                                                std::span<const Waypoint> stops) {
  std::vector<Stop> stands;
  for (const Waypoint& stop : stops) {
    if (!same_place(at, stop.pose)) {
      auto next = leg(vehicle, at, stop.pose, &stop == &stops.back());
      if (!next) return result::forward(next);
      auto joined = whole ? splice(*whole, 0, whole->mission.path.size() - 1, (*next)->route)
                          : result::Result<Route>((*next)->route);
      if (!joined) return joined;
      whole = *std::move(joined);
    } else if (!whole) {
      auto here = stand(vehicle, at);
      if (!here) return here;
      whole = *std::move(here);
    }
    at = whole->mission.path.back().pose;
    stands.push_back(stop.stop);
    stands.back().pose = whole->mission.path.size() - 1;
    stands.back().arc_m = whole->end_m();
  }
  if (!whole) return stand(vehicle, at);
  std::vector<double> driving_s = std::move(whole->driving_s);
  whole->mission.vehicle = homes_[vehicle].vehicle;
  whole->mission.grown.envelope.vehicle = homes_[vehicle].vehicle;
  whole->mission.stops = std::move(stands);
  return make_route(std::move(whole->mission), std::move(driving_s));
}

// The first half metre needs no more room than the outline.
result::Result<Route> RoutePlanner::tight_leg(const OccupancyGrid& grid, const Path& path) const {
  constexpr double kTight_m = 0.5;
  EnvelopeOptions tight = settings_.envelope;
  tight.growth_m = 0.0;
  tight.stretch_m = 4.0 * kTight_m;
  const bool is_long = path.back().arc_m - path.front().arc_m > 2.0 * kTight_m;
  const std::size_t cut = is_long ? pose_at(path, path.front().arc_m + kTight_m) : path.size() - 1;
  std::vector<EnvelopePart> parts = {{cut, tight}};
  if (is_long) {
    for (const EnvelopePart& part : parts_from(path, cut)) parts.push_back(part);
  }
  auto grown = grow_in_parts(grid, planned_.footprint(), {}, path, parts);
  if (!grown) return result::forward(grown);
  VehicleMission mission;
  mission.model = planned_;
  mission.grown = *std::move(grown);
  mission.path = path;
  return make_route(std::move(mission), driving_times_s(path, settings_.limits));
}

std::uint32_t RoutePlanner::block(const ConvexPolygon& area, std::optional<Room> room) {
  return add({.area = area, .room = std::move(room), .open_to = {}, .since = 0});
}

std::uint32_t RoutePlanner::avoid(std::uint32_t vehicle, const ConvexPolygon& area) {
  return add({.area = {}, .room = Room{.area = area}, .open_to = vehicle, .since = 0});
}

std::uint32_t RoutePlanner::add(Blocked blocked) {
  blocked.since = ++changes_;
  const std::uint32_t number = next_block_++;
  const Blocked& made = blocked_.emplace(number, std::move(blocked)).first->second;
  layers_.clear();
  // What was enclosed still is; what was not may be now.
  std::erase_if(approaches_, [](const auto& entry) { return !entry.second.has_value(); });
  std::erase_if(legs_, [&](const auto& entry) {
    const ConvexPolygon* closed = made.closed_on(std::get<LayerKey>(entry.first));
    return closed != nullptr && std::ranges::any_of(entry.second.route.mission.grown.envelope.polygons,
                                                    [&](const EnvelopePolygon& polygon) {
                                                      return overlaps(polygon.area, *closed);
                                                    });
  });
  return number;
}

// Ways that were planned while it was blocked may be longer than need be.
void RoutePlanner::unblock(std::uint32_t number) {
  const auto found = blocked_.find(number);
  if (found == blocked_.end()) return;
  ++changes_;
  std::erase_if(legs_, [&](const auto& entry) { return entry.second.planned >= found->second.since; });
  blocked_.erase(found);
  layers_.clear();
  in_doubt_.clear();
  approaches_.clear();
}

template <typename Part>
bool RoutePlanner::meets(const Pose& pose, Part&& part) const {
  if (blocked_.empty()) return false;
  const ConvexPolygon outline = footprint_at(pose, planned_.footprint());
  return std::ranges::any_of(blocked_, [&](const auto& entry) {
    const ConvexPolygon* area = part(entry.second);
    return area != nullptr && overlaps(outline, *area);
  });
}

bool RoutePlanner::meets_blocked(const Pose& pose) const {
  return meets(pose, [](const Blocked& blocked) { return blocked.area ? &*blocked.area : nullptr; });
}

bool RoutePlanner::meets_room(const Pose& pose) const {
  return meets(pose, [](const Blocked& blocked) { return blocked.room ? &blocked.room->area : nullptr; });
}

bool RoutePlanner::rests_in_room(const Pose& pose) const {
  return meets(pose, [](const Blocked& blocked) {
    return blocked.area && blocked.room ? &blocked.room->area : nullptr;
  });
}

}  // namespace stepwright::fleet
