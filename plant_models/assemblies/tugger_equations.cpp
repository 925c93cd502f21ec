#include "plant_models/assemblies/tugger_equations.h"

#include <cmath>

namespace stepwright::assemblies {
namespace {

BicycleFigures tractor_figures(const TuggerParameters& p) {
  const double whole_kg = p.drive.tractor_kg + static_cast<double>(most_trailers(p)) * p.drive.trailer_kg;
  return {.wheelbase_m = p.links.wheelbase_m,
          .full_lock_rad = p.steering.full_lock_rad,
          .lock_time_constant_s = p.steering.time_constant_s,
          .lock_rate_rad_s = p.steering.rate_rad_s,
          .top_speed_m_s = p.drive.top_speed_m_s,
          .time_constant_s = p.drive.time_constant_s,
          .drive_force_n = whole_kg * p.drive.acceleration_m_s2,
          .brake_force_n = whole_kg * p.drive.braking_m_s2,
          .parking_brake_n = whole_kg * p.drive.spring_brake_m_s2,
          .empty_mass_kg = p.drive.tractor_kg,
          .drive_slip = p.slip.drive_slip,
          .understeer_s2_m2 = p.slip.understeer_s2_m2,
          .load_understeer_s2_m2_kg = 0.0};
}

}  // namespace

TuggerEquations::TuggerEquations(const TuggerParameters& parameters)
    : bicycle_(tractor_figures(parameters)),
      trailers_(most_trailers(parameters)),
      hitch_m_(parameters.links.hitch_m),
      hitch_slip_s2_m2_(parameters.slip.hitch_slip_s2_m2) {}

void TuggerEquations::derivative(double, std::span<const double> y, std::span<double> dydt) const {
  bicycle_.derivative(modes, y, dydt);
  double pulled_m_s = bicycle_.ground_speed_m_s(modes, y);  // of the link in front, along its own heading
  double front_rad = y[kBicycleHeading];
  for (std::size_t k = 0; k < trailers_; ++k) {
    const double heading = y[kTuggerTrailer + k];
    const double slip = 1.0 + hitch_slip_s2_m2_ * pulled_m_s * pulled_m_s;
    dydt[kTuggerTrailer + k] =
        k < coupled ? pulled_m_s / hitch_m_ * std::sin(front_rad - heading) * slip : 0.0;
    pulled_m_s *= std::cos(front_rad - heading);
    front_rad = heading;
  }
}

}  // namespace stepwright::assemblies
