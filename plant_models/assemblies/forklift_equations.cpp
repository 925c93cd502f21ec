#include "plant_models/assemblies/forklift_equations.h"

namespace stepwright::assemblies {
namespace {

BicycleFigures figures_of(const ForkliftParameters& p) {
  return {.wheelbase_m = p.body.wheelbase_m,
          .full_lock_rad = full_lock_rad(p),
          .lock_time_constant_s = p.steering.time_constant_s,
          .lock_rate_rad_s = p.steering.rate_rad_s,
          .top_speed_m_s = p.drive.top_speed_m_s,
          .time_constant_s = p.drive.time_constant_s,
          .drive_force_n = p.drive.drive_force_n,
          .brake_force_n = p.drive.brake_force_n,
          .parking_brake_n = p.drive.parking_brake_n,
          .empty_mass_kg = p.drive.empty_mass_kg,
          .drive_slip = p.slip.drive_slip,
          .understeer_s2_m2 = p.slip.understeer_s2_m2,
          .load_understeer_s2_m2_kg = p.slip.load_understeer_s2_m2_kg};
}

}  // namespace

ForkliftEquations::ForkliftEquations(const ForkliftParameters& parameters)
    : bicycle_(figures_of(parameters)) {}

}  // namespace stepwright::assemblies
