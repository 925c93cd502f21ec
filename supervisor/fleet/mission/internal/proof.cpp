#include "supervisor/fleet/mission/internal/proof.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "supervisor/fleet/lattice/swept_cells.h"
#include "supervisor/fleet/network/network.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::ConvexPolygon;

constexpr std::uint64_t kMostExpanded = 500'000;
constexpr double kSweptStep_m = 0.01;

// Start, first departure and arrival of each vehicle, begin and end of each of its stops.
class TimesOnly {
 public:
  explicit TimesOnly(const ProofInput& input) : input_(input) {
    std::uint32_t next = 1;
    for (const Route& route : input.routes) {
      first_.push_back(next);
      next += 2 + 2 * std::max<std::uint32_t>(1, static_cast<std::uint32_t>(route.size()));
    }
    timepoints_ = next;
  }

  bool contradict() const {
    Network network(timepoints_);
    for (std::uint32_t v = 0; v < input_.routes.size(); ++v) {
      if (!post_vehicle(network, v)) return true;
    }
    return std::ranges::any_of(input_.problem.constraints, [&](const MissionConstraint& constraint) {
      const Timepoint from = timepoint(constraint.from);
      const Timepoint to = timepoint(constraint.to);
      const std::int64_t least = constraint.distance.least.count(), most = constraint.distance.most.count();
      return !post(network, from, to, least) || !post(network, to, from, -most);
    });
  }

 private:
  Timepoint start(std::size_t v) const { return Timepoint(first_[v]); }
  Timepoint departure(std::size_t v) const { return Timepoint(first_[v] + 1); }
  Timepoint begin(std::size_t v, std::size_t k) const {
    return Timepoint(first_[v] + 2 + 2 * static_cast<std::uint32_t>(k));
  }
  Timepoint end(std::size_t v, std::size_t k) const { return Timepoint(begin(v, k).value + 1); }
  // That of a vehicle without stops is a timepoint of its own.
  Timepoint arrival(std::size_t v) const {
    return end(v, input_.routes[v].empty() ? 0 : input_.routes[v].size() - 1);
  }

  // Distances of the horizon bind nothing.
  static bool post(Network& network, Timepoint from, Timepoint to, std::int64_t least_ms) {
    if (least_ms <= -kHorizon_ms) return true;
    const auto whole = static_cast<std::int32_t>(std::min<std::int64_t>(least_ms, kHorizon_ms + 1));
    return network.post({from, to, whole, 0});
  }

  bool post_vehicle(Network& network, std::uint32_t v) const {
    const MissionVehicle& vehicle = input_.problem.vehicles[v];
    bool good = post(network, kOrigin, start(v), vehicle.available.count()) &&
                post(network, start(v), departure(v), 0) && post(network, departure(v), arrival(v), 0);
    const Route& route = input_.routes[v];
    const auto legs = legs_of(input_.problem, v, route);
    for (std::size_t k = 0; k < route.size() && good; ++k) {
      const double least_m =
          input_.floor.planner(legs[k].model).least_ways_m({&legs[k].from, 1}, legs[k].to)[0];
      const auto way = least_leg_time(input_.floor, legs[k], least_m, vehicle.speed.max_mps, false);
      const auto service = input_.problem.locations[route[k].location].service;
      good = post(network, k == 0 ? start(v) : end(v, k - 1), begin(v, k), way.count()) &&
             post(network, begin(v, k), end(v, k), service.count());
    }
    return good;
  }

  Timepoint timepoint(const MomentRef& at) const {
    switch (at.moment) {
      case Moment::TimeZero:
        return kOrigin;
      case Moment::VehicleStart:
        return start(at.index);
      case Moment::VehicleEnd:
        return departure(at.index);
      case Moment::VehicleArrival:
        return arrival(at.index);
      default:
        break;
    }
    assert(at.moment == Moment::TaskStart || at.moment == Moment::TaskEnd);
    for (std::size_t v = 0; v < input_.routes.size(); ++v) {
      for (std::size_t k = 0; k < input_.routes[v].size(); ++k) {
        if (input_.routes[v][k].task != at.index) continue;
        return at.moment == Moment::TaskStart ? begin(v, k) : end(v, k);
      }
    }
    return kOrigin;
  }

  const ProofInput& input_;
  std::vector<std::uint32_t> first_;  // timepoint by vehicle
  std::size_t timepoints_ = 0;
};

// Cells in which no swept cell of this vehicle can lie unless its outline overlaps the area: swept cells hold
// what the outline passes within a margin, too.
void block_within(OccupancyGrid& map, const ConvexPolygon& area, const VehicleModel& model) {
  const double turned = 1.0 + model.circumscribed_radius_m() * model.largest_curvature_1pm();
  const double margin_m = SweptCells::clearance_m(model) + kSweptStep_m + 0.5 * kPathSample_m * turned;
  const double side_m = map.frame().resolution_m;
  for (const RowSpan& span : covered_spans(area, map.frame())) {
    for (std::int32_t column = span.first; column <= span.last; ++column) {
      const geometry::Point low = map.frame().corner({column, span.row});
      const double left = low.x_m - margin_m, right = low.x_m + side_m + margin_m;
      const double bottom = low.y_m - margin_m, top = low.y_m + side_m + margin_m;
      const std::array<geometry::Point, 4> corners = {
          geometry::Point{left, bottom}, {right, bottom}, {right, top}, {left, top}};
      const bool within = std::ranges::all_of(corners, [&](geometry::Point p) { return area.contains(p); });
      if (within && map.contains({column, span.row})) map.set({column, span.row}, true);
    }
  }
}

bool stands_for_ever(const VehicleMission& mission) {
  return mission.path.size() == 1 && mission.grown.envelope.polygons.size() == 1;
}

// In strict schedules nobody ever passes who stands all the time.
bool closed_in(const ProofInput& input, std::size_t v) {
  const auto legs = legs_of(input.problem, v, input.routes[v]);
  if (legs.empty()) return false;
  OccupancyGrid map = input.floor.map();
  bool any = false;
  for (std::size_t other = 0; other < input.missions.size(); ++other) {
    if (other == v || !stands_for_ever(input.missions[other])) continue;
    block_within(map, input.missions[other].grown.envelope.polygons.front().area, input.missions[v].model);
    any = true;
  }
  if (!any) return false;
  const PathPlanner planner = input.floor.planner(legs.front().model).on(map);
  return std::ranges::any_of(legs, [&](const LegRequest& leg) {
    const PathAnswer answer = planner.plan(
        leg.from, leg.to,
        {.first_weight = 2.0, .last_weight = 2.0, .most_expanded = kMostExpanded, .cancel = input.cancel});
    return answer.end == PathEnd::Unreachable || answer.end == PathEnd::Refused;
  });
}

}  // namespace

bool no_paths_help(const ProofInput& input) {
  assert(input.problem.goals.empty());
  bool chosen = false;
  for (std::size_t v = 0; v < input.routes.size(); ++v) {
    chosen |= is_planned(input.problem.vehicles[v]) && !input.routes[v].empty();
  }
  if (!chosen) return true;
  if (TimesOnly(input).contradict()) return true;
  if (input.mode != Mode::Strict) return false;
  for (std::size_t v = 0; v < input.routes.size(); ++v) {
    if (is_planned(input.problem.vehicles[v]) && closed_in(input, v)) return true;
  }
  return false;
}

}  // namespace stepwright::fleet::internal
