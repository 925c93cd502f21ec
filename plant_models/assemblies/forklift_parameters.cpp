#include "plant_models/assemblies/forklift_parameters.h"

#include <cmath>

#include "plant_models/assemblies/requirements.h"

namespace stepwright::assemblies {

result::Result<void> validate(const ForkliftParameters& p) {
  Requirements wanted;
  wanted.positive(p.body.front_m, "forklift: front_m");
  wanted.positive(p.body.rear_m, "forklift: rear_m");
  wanted.positive(p.body.width_m, "forklift: width_m");
  wanted.require(p.body.wheelbase_m > 0.0 && p.body.wheelbase_m <= p.body.rear_m,
                 "forklift: wheelbase_m must be positive and at most rear_m",
                 "the steered wheel is inside of the body");
  wanted.positive(p.drive.top_speed_m_s, "forklift: top_speed_m_s");
  wanted.positive(p.drive.time_constant_s, "forklift: drive time_constant_s");
  wanted.positive(p.drive.drive_force_n, "forklift: drive_force_n");
  wanted.positive(p.drive.brake_force_n, "forklift: brake_force_n");
  wanted.positive(p.drive.parking_brake_n, "forklift: parking_brake_n");
  wanted.positive(p.drive.empty_mass_kg, "forklift: empty_mass_kg");
  wanted.positive(p.steering.turning_radius_m, "forklift: turning_radius_m");
  wanted.positive(p.steering.time_constant_s, "forklift: steering time_constant_s");
  wanted.positive(p.steering.rate_rad_s, "forklift: rate_rad_s");
  wanted.require(p.slip.drive_slip >= 0.0 && p.slip.drive_slip < 1.0,
                 "forklift: drive_slip must lie in 0..1, 1 not included");
  wanted.not_negative(p.slip.understeer_s2_m2, "forklift: understeer_s2_m2");
  wanted.not_negative(p.slip.load_understeer_s2_m2_kg, "forklift: load_understeer_s2_m2_kg");
  wanted.not_negative(p.greatest_load_kg, "forklift: greatest_load_kg");
  return wanted.finish();
}

double full_lock_rad(const ForkliftParameters& p) {
  return std::atan(p.body.wheelbase_m / p.steering.turning_radius_m);
}

}  // namespace stepwright::assemblies
