#pragma once

// Limits of a vehicle's motion as its controller knows them, its measured state and its commands. Values; any
// thread.

namespace stepwright::fleet {

struct DriveLimits {
  double wheelbase_m = 1.9;
  double top_speed_m_s = 1.5;  // forward and in reverse
  double speed_up_m_s2 = 0.5;
  double brake_m_s2 = 0.6;       // planned with
  double hard_brake_m_s2 = 1.2;  // what the controller may use to keep to the plan
  double lateral_m_s2 = 0.8;     // of a curve, at most
  double full_lock_rad = 0.497;
  double lock_rate_rad_s = 0.5;
  // The lags of the drives, which commands make up for.
  double speed_lag_s = 0.3;
  double lock_lag_s = 0.15;
};

// As measured; the reference point is in the middle of the axle that does not steer.
struct VehicleState {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double speed_m_s = 0.0;  // negative in reverse
  double lock_rad = 0.0;   // steering; positive turns left when driving forward
};

struct DriveCommand {
  double speed_m_s = 0.0;
  double lock_rad = 0.0;
};

}  // namespace stepwright::fleet
