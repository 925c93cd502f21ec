#pragma once

// Data of the blocks of vehicles: paths as ST initial values, and the figures of a vehicle. Pure functions;
// any thread.
//
// The names of tables end with a digest of what they hold: an online change carries variables by name, and a
// table with other content must not keep the old one.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/graphic/project.h"
#include "supervisor/vehicle/path_samples.h"

namespace stepwright::vehicle {

// Of a text, in names: eight hexadecimal digits.
std::string digest(std::string_view text);

// A global ARRAY[0..count-1] OF `type`, WHAT_NAME_DIGEST; `rows` are its values, with commas between them.
graphic::Variable data_table(const std::string& what, const std::string& name, const char* type,
                             std::size_t count, const std::string& rows, std::string comment);

// ARRAY OF MC_PATH_POINT; requires at least one sample.
graphic::Variable path_table(const std::string& name, const std::vector<PathSample>& samples,
                             std::string comment);
inline constexpr std::size_t kPathSampleBytes = 40;

// Of a VEHICLE_REF (ladder/driver/library/vehicle.st).
struct VehicleFigures {
  double wheelbase_m = 1.0;
  double front_m = 1.0;
  double rear_m = 1.0;
  double half_width_m = 0.5;
  double top_speed_m_s = 1.0;
  double speed_up_m_s2 = 0.5;
  double brake_m_s2 = 0.6;
  double hard_brake_m_s2 = 1.2;
  double full_lock_rad = 0.5;
  double lock_rate_rad_s = 0.5;
  double speed_lag_s = 0.3;
  double lock_lag_s = 0.15;
  double phase = 0.0;
};
// "(Wheelbase := 1.0, ...)"
std::string vehicle_initial(const VehicleFigures& figures);

}  // namespace stepwright::vehicle
