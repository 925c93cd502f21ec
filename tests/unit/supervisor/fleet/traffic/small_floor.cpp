#include "tests/unit/supervisor/fleet/traffic/small_floor.h"

#include <algorithm>
#include <numbers>

#include "tests/support/fleet_traffic/traffic_invariants.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{500};
constexpr double kSpeed_m_s = 1.0;
constexpr double kHaltBefore_m = 0.3;

void fill(OccupancyGrid& grid, geometry::Point low, geometry::Point high, bool blocked) {
  const Cell first = grid.frame().cell_at(low + geometry::Point{0.1, 0.1});
  const Cell last = grid.frame().cell_at(high - geometry::Point{0.1, 0.1});
  for (int row = first.row; row <= last.row; ++row) {
    for (int column = first.column; column <= last.column; ++column) grid.set({column, row}, blocked);
  }
}

geometry::Pose bay(std::uint32_t vehicle) {
  const double x = 10.0 + 6.0 * (vehicle / 2);
  return vehicle % 2 == 0 ? geometry::Pose{x, 2.2, -0.5 * std::numbers::pi}
                          : geometry::Pose{x, 33.8, 0.5 * std::numbers::pi};
}

OccupancyGrid draw(std::uint32_t vehicles) {
  OccupancyGrid grid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 220, .rows = 180}, true);
  fill(grid, {0.4, 6.0}, {43.6, 30.0}, false);
  fill(grid, {9.0, 14.0}, {35.0, 22.0}, true);
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    const geometry::Pose at = bay(v);
    const bool below = v % 2 == 0;
    fill(grid, {at.x_m - 1.4, below ? 0.2 : 30.0}, {at.x_m + 1.4, below ? 6.0 : 35.8}, false);
  }
  return grid;
}

}  // namespace

SmallFloor::SmallFloor(std::uint32_t vehicles)
    : permitted_m_(vehicles, 0.0), served_(vehicles), standing_until_(vehicles, milliseconds(0)) {
  const RouteSettings settings;
  primitives_ = std::make_unique<PrimitiveSet>(with_margin(settings), LatticeOptions{});
  table_ = std::make_unique<HeuristicTable>(
      HeuristicTable::build(*primitives_, {.range_m = 4.0, .margin_m = 3.0, .threads = 1}));
  std::vector<HomePlace> homes;
  for (std::uint32_t v = 0; v < vehicles; ++v) homes.push_back({"v" + std::to_string(v + 1), bay(v)});
  planner_.emplace(
      RoutePlanner::create(draw(vehicles), *primitives_, *table_, std::move(homes), settings).value());
  std::vector<Route> routes;
  for (std::uint32_t v = 0; v < vehicles; ++v) routes.push_back(planner_->stand(v, bay(v)).value());
  traffic_.emplace(Traffic::create(std::move(routes), {}, now_).value());
  events_.emplace(*traffic_, *planner_);
}

geometry::Pose SmallFloor::station(std::uint32_t number) {
  return {number % 2 == 0 ? 16.0 : 28.0, number < 2 ? 10.0 : 26.0, 0.0};
}

Waypoint SmallFloor::stop(const geometry::Pose& pose, const std::string& goal, int service_ms) {
  Waypoint made{pose, {}};
  made.stop.kind = StopKind::PickUp;
  made.stop.goal = goal;
  made.stop.service = milliseconds(service_ms);
  return made;
}

result::Result<Change> SmallFloor::send(std::uint32_t vehicle, std::uint32_t number) {
  return send(vehicle, station(number));
}

result::Result<Change> SmallFloor::send(std::uint32_t vehicle, const geometry::Pose& by) {
  const auto branch = traffic_->branch(vehicle);
  if (!branch) return result::fail("F1002", {}, "no place to branch off");
  const std::vector<Waypoint> stops = {stop(by, std::to_string(goals_++)), {planner_->home(vehicle), {}}};
  const auto route = planner_->plan(vehicle, branch->place, stops);
  if (!route) return tl::unexpected(route.error());
  auto made = traffic_->reroute(vehicle, *branch, *route, now_);
  if (made) changed(vehicle);
  return made;
}

void SmallFloor::tick(const std::set<std::uint32_t>& stand) {
  now_ += kTick;
  for (std::uint32_t v = 0; v < traffic_->vehicles(); ++v) {
    if (traffic_->removed(v)) continue;
    const Route& route = traffic_->route(v);
    VehicleLocation at{traffic_->arc_m(v), 0.0, standing_until_[v]};
    if (!stand.contains(v) && now_ >= standing_until_[v]) {
      double most_m = std::min(route.end_m(), traffic_->permission(v, now_).permitted_m - kHaltBefore_m);
      const Stop* next = nullptr;
      for (const Stop& stop : route.mission.stops) {
        if (stop.kind == StopKind::Park || stop.arc_m < at.arc_m - 1e-6 || served_[v].contains(stop.goal))
          continue;
        next = &stop;
        break;
      }
      if (next != nullptr) most_m = std::min(most_m, next->arc_m);
      const double to_m = std::min(most_m, at.arc_m + kSpeed_m_s * 0.5);
      at.speed_m_s = std::max(0.0, to_m - at.arc_m) / 0.5;
      at.arc_m = std::max(at.arc_m, to_m);
      if (next != nullptr && at.arc_m >= next->arc_m) {
        served_[v].insert(next->goal);
        standing_until_[v] = now_ + next->service;
        at.speed_m_s = 0.0;
        at.standing_until = standing_until_[v];
      }
    }
    traffic_->progress(v, at, now_);
  }
}

bool SmallFloor::settle(int ticks) {
  for (int k = 0; k < ticks; ++k) {
    bool all = true;
    for (std::uint32_t v = 0; v < traffic_->vehicles(); ++v)
      all = all && (traffic_->removed(v) || traffic_->rests(v));
    if (all) return true;
    tick();
    if (!broken().empty()) return false;
  }
  return false;
}

std::string SmallFloor::broken() {
  for (std::uint32_t v = 0; v < traffic_->vehicles(); ++v) {
    if (traffic_->removed(v)) continue;
    const auto& own = traffic_->route(v).mission.grown.envelope.polygons;
    for (std::uint32_t u = 0; u < v; ++u) {
      if (traffic_->removed(u)) continue;
      const auto& other = traffic_->route(u).mission.grown.envelope.polygons;
      for (std::uint32_t k = traffic_->first(v); k < traffic_->granted(v); ++k) {
        for (std::uint32_t i = traffic_->first(u); i < traffic_->granted(u); ++i) {
          if (overlaps(own[k].area, other[i].area))
            return "v" + std::to_string(v + 1) + " and v" + std::to_string(u + 1) +
                   " are permitted in polygons that overlap";
        }
      }
    }
    const double permitted_m = traffic_->permission(v, now_).permitted_m;
    if (permitted_m < permitted_m_[v] - 1e-9 && !traffic_->held(v))
      return "what v" + std::to_string(v + 1) + " was permitted was taken back";
    permitted_m_[v] = permitted_m;
    if (traffic_->held(v)) permitted_m_[v] = 0.0;
  }
  return support::broken_invariant(*traffic_);
}

}  // namespace stepwright::fleet
