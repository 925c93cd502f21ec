#pragma once

// The figures of the tank bench (paper 6, "Planning Domain Modeling"; the sizes are ours, see
// plant_models/doc/bench.md). Volumes in litres and levels in percent here, because that is what people
// write; the equations use SI units.

#include <array>
#include <cstdint>

#include "plant_models/assemblies/bench_names.h"
#include "plant_models/assemblies/level_sensor.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

struct TankParameters {
  double capacity_l = 3.0;       // volume at 100 percent
  double height_m = 0.30;        // liquid height at 100 percent
  double initial_percent = 0.0;  // 0..100
};

// An electro-pump with the line behind it. Head H = H0 w^2 (affinity law), loss R q (laminar hose),
// check valve: q = max(0, H0 w^2 - dh) / R with dh = lift + h_target - h_source.
struct PumpParameters {
  double time_constant_s = 0.25;         // first-order spin-up and run-down of the speed w
  double shutoff_head_m = 1.8;           // H0 at nominal speed
  double resistance_m_per_m3_s = 6.0e3;  // R
  double lift_m = 0.35;                  // highest point of the line above the source's bottom
};

struct VehicleParameters {
  double empty_mass_kg = 4.0;
  double drive_force_n = 2.8;
  double viscous_friction_n_per_m_s = 10.0;
  double coulomb_friction_n = 0.4;
  double static_friction_n = 0.5;  // at least the Coulomb friction, less than the drive force
  double brake_force_n = 15.0;     // acts whenever the drive has no single direction
  double initial_position_m = 0.0;
};

struct TrackParameters {
  std::array<double, kPlaces> position_m = {0.0, -1.0, 1.0};  // f1, a1, a2
  double switch_half_width_m = 0.03;
  double switch_hysteresis_m = 0.001;  // opens this much later than it closes
  double end_stop_m = 1.05;            // stops at +- this position
};

struct BenchParameters {
  std::array<TankParameters, kTanks> tanks = {{
      {.capacity_l = 20.0, .initial_percent = 55.0},  // f1: must hold all liquid at once
      {.initial_percent = 20.0},                      // v1
      {.initial_percent = 20.0},                      // a1
      {.initial_percent = 20.0},                      // a2
  }};
  std::array<PumpParameters, kPumps> pumps = {{
      {.lift_m = 0.34},
      {},
      {.shutoff_head_m = 1.2, .resistance_m_per_m3_s = 8.0e3, .lift_m = 0.40},
      {.shutoff_head_m = 1.2, .resistance_m_per_m3_s = 8.0e3, .lift_m = 0.40},
  }};
  VehicleParameters vehicle;
  TrackParameters track;
  double density_kg_per_l = 1.0;
  double suction_percent = 0.5;       // below this level the intake sucks air and outflow fades to zero
  double overflow_rate_per_s = 20.0;  // outflow per volume above 100 percent
  std::array<LevelCalibration, kLevelSensors> calibration = {{
      // Paper 6, Table 4: counts at two levels; one plan level is 10 percent.
      {.low_percent = 20, .low_counts = 1322, .high_percent = 100, .high_counts = 3784},  // S1, v1
      {.low_percent = 20, .low_counts = 736, .high_percent = 50, .high_counts = 1854},    // S2, a1
      {.low_percent = 20, .low_counts = 1061, .high_percent = 50, .high_counts = 1773},   // S3, a2
  }};
  SensorUncertainty uncertainty;  // SensorUncertainty::none() for exact sensors
  std::uint64_t seed = 1;
};

// Fails with one C0321 per figure that has no physical sense or breaks a promise of the model (liquid
// siphoning back, a supplier too small for all the liquid, overlapping switches, ...).
[[nodiscard]] result::Result<void> validate(const BenchParameters& parameters);

}  // namespace stepwright::assemblies
