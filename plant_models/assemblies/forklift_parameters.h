#pragma once

// The figures of a counterbalanced forklift: steered at the rear, driven and not steered at the front. Its
// reference point is the middle of the front axle. Defaults: 1.4 x 4.0 m with its forks, turning radius 3.5
// m, 1.5 m/s; see plant_models/doc/forklift.md.

#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

struct ForkliftBody {
  double front_m = 1.6;  // reference point to the tips of the forks
  double rear_m = 2.4;   // reference point to the back
  double width_m = 1.4;
  double wheelbase_m = 1.9;
};

// Speed of the drive wheels: a first-order controller whose force is limited.
struct ForkliftDrive {
  double top_speed_m_s = 1.5;  // forward and in reverse
  double time_constant_s = 0.3;
  double drive_force_n = 3600.0;
  double brake_force_n = 7200.0;     // of the controller
  double parking_brake_n = 12000.0;  // of the spring brake that holds while the drive is not enabled
  double empty_mass_kg = 4500.0;
};

struct ForkliftSteering {
  double turning_radius_m = 3.5;  // of the reference point, at full lock
  double time_constant_s = 0.15;
  double rate_rad_s = 0.6;
};

// How the ground is left: a part of the wheels' speed that the vehicle does not make, and understeer.
struct ForkliftSlip {
  double drive_slip = 0.01;                // 0..1
  double understeer_s2_m2 = 0.02;          // curvature / (1 + k v^2), empty
  double load_understeer_s2_m2_kg = 1e-5;  // more of it for each kg of load
};

struct ForkliftParameters {
  ForkliftBody body;
  ForkliftDrive drive;
  ForkliftSteering steering;
  ForkliftSlip slip;
  double greatest_load_kg = 2500.0;
};

// Fails with one C0321 per figure that has no physical sense.
[[nodiscard]] result::Result<void> validate(const ForkliftParameters& parameters);

// Of the rear wheel, rad: at this angle the reference point moves on a circle of the turning radius.
double full_lock_rad(const ForkliftParameters& parameters);

}  // namespace stepwright::assemblies
