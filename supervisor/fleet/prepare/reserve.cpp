#include "supervisor/fleet/prepare/reserve.h"

namespace stepwright::fleet {

VehicleModel with_reserve(VehicleModel model, const DriveReserve& reserve) {
  model.front_m += reserve.room_m;
  model.rear_m += reserve.room_m;
  model.width_m += 2.0 * reserve.room_m;
  model.min_turning_radius_m += reserve.radius_m;
  return model;
}

MissionProblem with_reserve(MissionProblem problem, const DriveReserve& reserve) {
  for (VehicleClass& of : problem.classes) of.model = with_reserve(of.model, reserve);
  return problem;
}

}  // namespace stepwright::fleet
