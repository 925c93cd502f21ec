#include "supervisor/fleet/mission/internal/mission_builder.h"

#include <cassert>
#include <utility>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet::internal {

geometry::Path join_legs(std::span<const LatticePath* const> legs) {
  geometry::Path path;
  for (const LatticePath* leg : legs) {
    const double begun_m = path.empty() ? 0.0 : path.back().arc_m;
    if (path.size() == 1) path.front().travel = leg->poses.front().travel;
    // A leg begins with the pose at which the one before ends.
    for (std::size_t k = path.empty() ? 0 : 1; k < leg->poses.size(); ++k) {
      geometry::PathPose pose = leg->poses[k];
      pose.arc_m += begun_m;
      path.push_back(pose);
    }
  }
  return path;
}

geometry::Path behind(const geometry::Path& lead_in, geometry::Path way, std::vector<Stop>& stops) {
  if (lead_in.size() < 2) return way;
  geometry::Path path = lead_in;
  const std::size_t poses = path.size() - 1;
  const double begun_m = path.back().arc_m;
  for (std::size_t k = 1; k < way.size(); ++k) {
    path.push_back(way[k]);
    path.back().arc_m += begun_m;
  }
  for (Stop& stop : stops) {
    stop.pose += poses;
    stop.arc_m += begun_m;
  }
  return path;
}

result::Result<VehicleMission> route_mission(const MissionProblem& problem, std::size_t vehicle,
                                             const Route& route, std::span<const LatticePath* const> legs,
                                             const OccupancyGrid& map, const EnvelopeOptions& options) {
  std::vector<Stop> stops = route.empty() ? std::vector<Stop>() : stops_on(problem, route, legs);
  geometry::Path path = behind(problem.vehicles[vehicle].lead_in, join_legs(legs), stops);
  return build_mission(problem, vehicle, std::move(path), std::move(stops), map, options);
}

std::vector<Stop> stops_on(const MissionProblem& problem, const Route& route,
                           std::span<const LatticePath* const> legs) {
  assert(route.size() == legs.size());
  std::vector<Stop> stops;
  std::size_t pose = 0;
  double arc_m = 0.0;
  for (std::size_t k = 0; k < route.size(); ++k) {
    pose += legs[k]->poses.size() - 1;
    arc_m += legs[k]->length_m;
    const RouteStop& stop = route[k];
    const MissionLocation& location = problem.locations[stop.location];
    stops.push_back({.kind = stop.kind,
                     .location = location.name,
                     .goal = stop.goal ? problem.goals[*stop.goal].name : std::string(),
                     .amount = stop.amount,
                     .aboard = stop.aboard,
                     .pose = pose,
                     .arc_m = arc_m,
                     .service = location.service});
  }
  return stops;
}

std::vector<Stand> stands_of(std::span<const Stop> stops) {
  std::vector<Stand> stands;
  for (const Stop& stop : stops) stands.push_back({stop.pose, stop.service});
  return stands;
}

result::Result<VehicleMission> build_mission(const MissionProblem& problem, std::size_t vehicle,
                                             geometry::Path path, std::vector<Stop> stops,
                                             const OccupancyGrid& map, const EnvelopeOptions& options) {
  const MissionVehicle& of = problem.vehicles[vehicle];
  VehicleMission mission{.vehicle = of.name,
                         .model = problem.classes[of.vehicle_class].model,
                         .speed = of.speed,
                         .path = std::move(path),
                         .grown = {},
                         .stops = std::move(stops)};
  EnvelopeOptions own = options;
  own.speed = of.speed;
  auto grown = grow_between_stands(map, mission.model.footprint(), of.name, mission.path,
                                   stands_of(mission.stops), own);
  if (!grown) return result::forward(grown);
  mission.grown = *std::move(grown);
  return mission;
}

VehicleMission joined(VehicleMission first, VehicleMission second) {
  constexpr std::chrono::milliseconds kNever{kHorizon_ms};
  const std::size_t poses = first.path.size() - 1;
  const std::size_t polygons = first.grown.visits.size();
  const double begun_m = first.path.back().arc_m;
  if (first.path.size() == 1) first.path.front().travel = second.path.front().travel;
  for (std::size_t k = 1; k < second.path.size(); ++k) {
    first.path.push_back(second.path[k]);
    first.path.back().arc_m += begun_m;
  }
  for (Stop& stop : second.stops) {
    stop.pose += poses;
    stop.arc_m += begun_m;
    first.stops.push_back(std::move(stop));
  }
  for (std::size_t k = 0; k < second.grown.visits.size(); ++k) {
    Visit visit = second.grown.visits[k];
    visit.first_pose += poses;
    visit.last_pose += poses;
    visit.entry_m += begun_m;
    visit.exit_m += begun_m;
    first.grown.visits.push_back(visit);
    first.grown.envelope.polygons.push_back(std::move(second.grown.envelope.polygons[k]));
  }
  for (const std::size_t stand : second.grown.stands) first.grown.stands.push_back(stand + polygons);
  EnvelopePolygon& end = first.grown.envelope.polygons[polygons - 1];
  end.stay.most = kNever;
  end.overlap = {std::chrono::milliseconds(0), kNever};
  return first;
}

VehicleMission given_mission(const MissionProblem& problem, std::size_t vehicle) {
  const MissionVehicle& of = problem.vehicles[vehicle];
  VehicleMission mission{.vehicle = of.name,
                         .model = problem.classes[of.vehicle_class].model,
                         .speed = of.speed,
                         .path = {},
                         .grown = {},
                         .stops = {}};
  mission.grown.envelope = *of.envelope;
  return mission;
}

}  // namespace stepwright::fleet::internal
