#include "supervisor/vehicle/data_tables.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "supervisor/vehicle/literals.h"

namespace stepwright::vehicle {
namespace {

std::string row(const PathSample& s) {
  return fmt::format("({}, {}, {}, {}, {}, {}, {}, {}, {}, {})", member("X", s.pose.x_m),
                     member("Y", s.pose.y_m), member("Heading", s.pose.heading_rad),
                     member("Curvature", s.curvature_1_m), member("Arc", s.arc_m),
                     member("Speed", s.speed_m_s), member("Rest", s.rest_m), member("Left", s.left_m),
                     member("Right", s.right_m), member("Way", s.way));
}

}  // namespace

// FNV-1a, 32 bits.
std::string digest(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 16777619U;
  return fmt::format("{:08x}", hash);
}

graphic::Variable data_table(const std::string& what, const std::string& name, const char* type,
                             std::size_t count, const std::string& rows, std::string comment) {
  graphic::Variable made;
  made.type = fmt::format("ARRAY[0..{}] OF {}", count - 1, type);
  made.section = graphic::VariableSection::Global;
  made.initial = "[" + rows + "]";
  made.name = fmt::format("{}_{}_{}", what, name, digest(made.initial));
  made.comment = std::move(comment);
  return made;
}

graphic::Variable path_table(const std::string& name, const std::vector<PathSample>& samples,
                             std::string comment) {
  std::string rows;
  for (const PathSample& sample : samples) rows += (rows.empty() ? "" : ",\n") + row(sample);
  return data_table("path", name, "MC_PATH_POINT", samples.size(), rows, std::move(comment));
}

std::string vehicle_initial(const VehicleFigures& v) {
  const std::pair<const char*, double> figures[] = {{"Wheelbase", v.wheelbase_m},
                                                    {"Front", v.front_m},
                                                    {"Rear", v.rear_m},
                                                    {"HalfWidth", v.half_width_m},
                                                    {"MaxSpeed", v.top_speed_m_s},
                                                    {"Acceleration", v.speed_up_m_s2},
                                                    {"Deceleration", v.brake_m_s2},
                                                    {"HardDeceleration", v.hard_brake_m_s2},
                                                    {"MaxLock", v.full_lock_rad},
                                                    {"LockRate", v.lock_rate_rad_s},
                                                    {"SpeedLag", v.speed_lag_s},
                                                    {"LockLag", v.lock_lag_s},
                                                    {"Phase", v.phase}};
  std::string text;
  for (const auto& [name, value] : figures) text += (text.empty() ? "(" : ", ") + member(name, value);
  return text + ")";
}

}  // namespace stepwright::vehicle
