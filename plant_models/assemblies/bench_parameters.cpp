#include "plant_models/assemblies/bench_parameters.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "plant_models/assemblies/requirements.h"

namespace stepwright::assemblies {
namespace {

constexpr std::array<const char*, kTanks> kTankNames = {"f1", "v1", "a1", "a2"};
constexpr std::array<const char*, kPumps> kPumpNames = {"B1", "B2", "B3", "B4"};
constexpr std::array<Tank, kPumps> kSources = {Tank::F1, Tank::V1, Tank::A1, Tank::A2};

void check_tanks(const BenchParameters& p, Requirements& r) {
  double total_l = 0.0;
  for (std::size_t i = 0; i < kTanks; ++i) {
    const TankParameters& tank = p.tanks[i];
    const std::string name = std::string("tank ") + kTankNames[i];
    r.positive(tank.capacity_l, name + ": capacity_l");
    r.positive(tank.height_m, name + ": height_m");
    r.require(tank.initial_percent >= 0.0 && tank.initial_percent <= 100.0,
              name + ": initial_percent must lie in 0..100");
    total_l += tank.capacity_l * tank.initial_percent / 100.0;
  }
  r.require(total_l <= p.tanks[index(Tank::F1)].capacity_l, "the supplier f1 cannot hold all the liquid",
            "every tank overflows into f1: raise its capacity_l or lower the initial levels");
  r.positive(p.density_kg_per_l, "density_kg_per_l");
  r.require(p.suction_percent > 0.0 && p.suction_percent <= 10.0,
            "suction_percent must lie above 0, up to 10");
  r.positive(p.overflow_rate_per_s, "overflow_rate_per_s");
}

void check_pumps(const BenchParameters& p, Requirements& r) {
  for (std::size_t i = 0; i < kPumps; ++i) {
    const PumpParameters& pump = p.pumps[i];
    const std::string name = std::string("pump ") + kPumpNames[i];
    r.positive(pump.time_constant_s, name + ": time_constant_s");
    r.positive(pump.shutoff_head_m, name + ": shutoff_head_m");
    r.positive(pump.resistance_m_per_m3_s, name + ": resistance_m_per_m3_s");
    // 1.1: an overflowing tank stands above 100 percent.
    r.require(pump.lift_m >= 1.1 * p.tanks[index(kSources[i])].height_m,
              name + ": lift_m must be at least 1.1 times the height of its source tank",
              "a lower line would siphon the tank empty while the pump stands still");
  }
}

void check_vehicle(const BenchParameters& p, Requirements& r) {
  const VehicleParameters& v = p.vehicle;
  r.positive(v.empty_mass_kg, "vehicle: empty_mass_kg");
  r.positive(v.viscous_friction_n_per_m_s, "vehicle: viscous_friction_n_per_m_s");
  r.not_negative(v.coulomb_friction_n, "vehicle: coulomb_friction_n");
  r.not_negative(v.brake_force_n, "vehicle: brake_force_n");
  r.require(v.static_friction_n >= v.coulomb_friction_n && v.static_friction_n > 0.0,
            "vehicle: static_friction_n must be positive and at least coulomb_friction_n");
  r.require(std::isfinite(v.drive_force_n) && v.drive_force_n > v.static_friction_n,
            "vehicle: drive_force_n must exceed static_friction_n", "else the vehicle never starts");
}

void check_track(const BenchParameters& p, Requirements& r) {
  const TrackParameters& t = p.track;
  r.positive(t.switch_half_width_m, "track: switch_half_width_m");
  r.require(t.switch_hysteresis_m > 0.0 && t.switch_hysteresis_m <= t.switch_half_width_m,
            "track: switch_hysteresis_m must be positive and at most the half width");
  r.positive(t.end_stop_m, "track: end_stop_m");
  r.require(std::abs(p.vehicle.initial_position_m) <= t.end_stop_m,
            "vehicle: initial_position_m must lie between the end stops");
  for (std::size_t i = 0; i < kPlaces; ++i) {
    r.require(std::abs(t.position_m[i]) < t.end_stop_m, "track: every place must lie between the end stops");
    for (std::size_t k = i + 1; k < kPlaces; ++k) {
      const double apart = std::abs(t.position_m[i] - t.position_m[k]);
      r.require(apart > 2.0 * (t.switch_half_width_m + t.switch_hysteresis_m),
                "track: two switches would be closed at once", "move the places apart");
    }
  }
  // The solver looks at the switches at most every 0.1 s (CvodeSettings::max_step_s).
  const double top_speed = p.vehicle.drive_force_n / p.vehicle.viscous_friction_n_per_m_s;
  r.require(top_speed * 0.1 < 2.0 * t.switch_half_width_m,
            "track: the vehicle may pass a switch within 0.1 s, unseen",
            "widen the switch or slow the vehicle");
}

void check_sensors(const BenchParameters& p, Requirements& r) {
  for (const LevelCalibration& c : p.calibration) {
    r.require(std::isfinite(c.counts_per_percent()) && c.counts_per_percent() != 0.0,
              "calibration: the two points must differ in level and counts");
  }
  r.not_negative(p.uncertainty.bias_points, "uncertainty: bias_points");
  r.not_negative(p.uncertainty.drift_points, "uncertainty: drift_points");
  r.not_negative(p.uncertainty.noise_points, "uncertainty: noise_points");
}

}  // namespace

result::Result<void> validate(const BenchParameters& parameters) {
  Requirements requirements;
  check_tanks(parameters, requirements);
  check_pumps(parameters, requirements);
  check_vehicle(parameters, requirements);
  check_track(parameters, requirements);
  check_sensors(parameters, requirements);
  return requirements.finish();
}

}  // namespace stepwright::assemblies
