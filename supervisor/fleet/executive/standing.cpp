#include "supervisor/fleet/executive/standing.h"

#include <algorithm>

namespace stepwright::fleet {

geometry::ConvexPolygon place_around(const geometry::Pose& pose, const geometry::Footprint& outline,
                                     double along_m, double beside_m) {
  return footprint_at(pose, {.front_m = outline.front_m + along_m,
                             .rear_m = outline.rear_m + along_m,
                             .half_width_m = outline.half_width_m + beside_m});
}

void insert_standing(FleetPlan& plan, std::uint32_t vehicle, const std::string& name,
                     const VehicleModel& model, const geometry::Pose& pose,
                     const geometry::ConvexPolygon& place) {
  const auto moved = [vehicle](PolygonRef at) {
    if (at.vehicle >= vehicle) ++at.vehicle;
    return at;
  };
  for (TemporalConstraint& bound : plan.constraints) {
    bound.to.at = moved(bound.to.at);
    if (bound.from) bound.from->at = moved(bound.from->at);
  }
  Schedule& made = plan.schedule;
  for (Precedence& order : made.precedences) order = {moved(order.first), moved(order.second)};
  for (SpatialPair& pair : made.conflicts) pair = {moved(pair.a), moved(pair.b)};
  VehicleMission mission{.vehicle = name, .model = model, .speed = {}, .path = {}, .grown = {}, .stops = {}};
  mission.path = {{pose, 0.0, geometry::Travel::Forward}};
  mission.grown.envelope.vehicle = name;
  mission.grown.envelope.polygons.push_back({place, {}, {}});
  mission.grown.visits.push_back({});
  set_times(mission.grown, {.min_mps = 0.0});
  const auto at = static_cast<std::ptrdiff_t>(vehicle);
  plan.missions.insert(plan.missions.begin() + at, std::move(mission));
  made.earliest.insert(made.earliest.begin() + at, VehicleTimes(1));
  made.latest.insert(made.latest.begin() + at, VehicleTimes(1));
}

}  // namespace stepwright::fleet
