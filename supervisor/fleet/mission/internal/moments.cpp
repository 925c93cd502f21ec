#include "supervisor/fleet/mission/internal/moments.h"

#include <algorithm>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet::internal {

namespace {

using std::chrono::milliseconds;

// A timepoint of the network and how long after it the moment is.
struct Point {
  std::optional<TimepointRef> at;  // nothing: time zero
  milliseconds after{0};
};

PolygonRef polygon(std::size_t vehicle, std::size_t index) {
  return {static_cast<std::uint32_t>(vehicle), static_cast<std::uint32_t>(index)};
}

Point start_of_stop(const VehicleMission& mission, std::size_t vehicle, std::size_t stop) {
  const std::size_t k = mission.grown.stands[stop];
  const double inside_m = mission.stops[stop].arc_m - mission.grown.visits[k].entry_m;
  return {TimepointRef{polygon(vehicle, k), Side::Entry}, time_bounds(inside_m, mission.speed).least};
}

Point end_of_stop(const VehicleMission& mission, std::size_t vehicle, std::size_t stop) {
  return {TimepointRef{polygon(vehicle, mission.grown.stands[stop]), Side::Exit}, milliseconds(0)};
}

class Mapper {
 public:
  Mapper(const std::vector<Route>& routes, const std::vector<VehicleMission>& missions)
      : routes_(routes), missions_(missions) {}

  // One for each trip of a goal, one for everything else.
  std::vector<Point> points(const MomentRef& moment) const {
    const std::size_t index = moment.index;
    const auto last = [&] { return missions_[index].grown.envelope.polygons.size() - 1; };
    switch (moment.moment) {
      case Moment::TimeZero:
        return {Point{}};
      case Moment::VehicleStart:
        return {Point{TimepointRef{polygon(index, 0), Side::Entry}}};
      case Moment::VehicleEnd:
        return {Point{TimepointRef{polygon(index, 0), Side::Exit}}};
      case Moment::VehicleArrival:
        return {Point{TimepointRef{polygon(index, last()), Side::Exit}}};
      case Moment::GoalStart:
        return stops([&](const RouteStop& s) { return s.goal == index && s.kind == StopKind::PickUp; }, true);
      case Moment::GoalEnd:
        return stops([&](const RouteStop& s) { return s.goal == index && s.kind == StopKind::SetDown; },
                     false);
      case Moment::TaskStart:
        return stops([&](const RouteStop& s) { return s.task == index; }, true);
      case Moment::TaskEnd:
        return stops([&](const RouteStop& s) { return s.task == index; }, false);
    }
    return {};
  }

 private:
  template <typename Wanted>
  std::vector<Point> stops(const Wanted& wanted, bool start) const {
    std::vector<Point> found;
    for (std::size_t v = 0; v < routes_.size(); ++v) {
      for (std::size_t k = 0; k < routes_[v].size(); ++k) {
        if (!wanted(routes_[v][k])) continue;
        found.push_back(start ? start_of_stop(missions_[v], v, k) : end_of_stop(missions_[v], v, k));
      }
    }
    return found;
  }

  const std::vector<Route>& routes_;
  const std::vector<VehicleMission>& missions_;
};

// Distances that bind nothing stay so.
Bounds shifted(const Bounds& bounds, milliseconds by) {
  Bounds moved = bounds;
  if (std::abs(bounds.least.count()) < kHorizon_ms) moved.least += by;
  if (std::abs(bounds.most.count()) < kHorizon_ms) moved.most += by;
  return moved;
}

// A problem's constraints never end at time zero.
TemporalConstraint between(const std::string& name, const Point& from, const Point& to,
                           const Bounds& distance) {
  return {.name = name,
          .from = from.at,
          .to = to.at.value(),
          .distance = shifted(distance, from.after - to.after)};
}

bool of_goal(const MomentRef& moment) {
  return moment.moment == Moment::GoalStart || moment.moment == Moment::GoalEnd;
}

}  // namespace

MappedConstraints map_constraints(const MissionProblem& problem, const std::vector<Route>& routes,
                                  const std::vector<VehicleMission>& missions) {
  const Mapper mapper(routes, missions);
  MappedConstraints mapped;
  for (std::size_t v = 0; v < problem.vehicles.size(); ++v) {
    const MissionVehicle& vehicle = problem.vehicles[v];
    if (vehicle.available.count() == 0) continue;
    mapped.constraints.push_back({.name = vehicle.name + " is available",
                                  .from = {},
                                  .to = {polygon(v, 0), Side::Entry},
                                  .distance = {vehicle.available, milliseconds(kHorizon_ms)}});
    mapped.keys.push_back(vehicle.key + ".available_ms");
  }
  for (const MissionConstraint& constraint : problem.constraints) {
    const bool same_goal =
        constraint.from.index == constraint.to.index && of_goal(constraint.from) && of_goal(constraint.to);
    const auto from = mapper.points(constraint.from);
    const auto to = mapper.points(constraint.to);
    for (std::size_t i = 0; i < from.size(); ++i) {
      for (std::size_t k = 0; k < to.size(); ++k) {
        if (same_goal && i != k) continue;
        mapped.constraints.push_back(between(constraint.name, from[i], to[k], constraint.distance));
        mapped.keys.push_back(constraint.key);
      }
    }
  }
  return mapped;
}

}  // namespace stepwright::fleet::internal
