#include "supervisor/fleet/vda5050/link/vehicle_image.h"

#include <cmath>
#include <string_view>

namespace stepwright::vda5050_link {

namespace {

// `*` stands for the vehicle's variable; in the order in which `read` takes them.
constexpr std::array<std::string_view, 20> kNumberNames = {
    "vehicle_*.X",         "vehicle_*.Y",         "vehicle_*.Heading",      "vehicle_*.Speed",
    "vehicle_*.Lock",      "vehicle_*.Wheelbase", "vehicle_*.Front",        "vehicle_*.Rear",
    "vehicle_*.HalfWidth", "vehicle_*.MaxSpeed",  "vehicle_*.Acceleration", "vehicle_*.Deceleration",
    "vehicle_*.MaxLock",   "vehicle_*.ErrorX",    "vehicle_*.ErrorY",       "arc_*",
    "permitted_*",         "vehicle_*.ErrorID",   "vehicle_*.ErrorArea",    "areas_*"};
constexpr std::array<std::string_view, 6> kSwitchNames = {"vehicle_*.Known", "standing_*", "done_*",
                                                          "loaded_*",        "bumper_*",   "estop_ok"};

std::string filled(std::string_view name, const std::string& variable) {
  std::string text(name);
  if (const auto star = text.find('*'); star != std::string::npos) text.replace(star, 1, variable);
  return text;
}

template <std::size_t N>
bool find_all(const reader::ProgramInfo& program, const std::string& variable,
              const std::array<std::string_view, N>& names, std::array<reader::Variable, N>& into) {
  for (std::size_t k = 0; k < N; ++k) {
    const reader::Variable* const found = program.find(filled(names[k], variable));
    if (found == nullptr) return false;
    into[k] = *found;
  }
  return true;
}

}  // namespace

VehicleData data_of(const VehicleImage& seen) {
  VehicleData data;
  data.model.wheelbase_m = seen.wheelbase_m;
  data.model.front_m = seen.front_m;
  data.model.rear_m = seen.rear_m;
  data.model.width_m = 2.0 * seen.half_width_m;
  if (seen.max_lock_rad > 0.0)
    data.model.min_turning_radius_m = seen.wheelbase_m / std::tan(seen.max_lock_rad);
  data.max_mps = seen.max_mps;
  return data;
}

std::optional<VehicleTags> VehicleTags::find(const reader::ProgramInfo& program,
                                             const std::string& variable) {
  VehicleTags tags;
  if (!find_all(program, variable, kNumberNames, tags.numbers_)) return std::nullopt;
  if (!find_all(program, variable, kSwitchNames, tags.switches_)) return std::nullopt;
  return tags;
}

VehicleImage VehicleTags::read(std::span<const std::byte> image) const {
  std::array<double, kNumbers> n{};
  for (std::size_t k = 0; k < kNumbers; ++k) {
    n[k] = reader::read_number(numbers_[k], image);
    if (!std::isfinite(n[k])) n[k] = 0.0;
  }
  std::array<bool, kSwitches> b{};
  for (std::size_t k = 0; k < kSwitches; ++k) b[k] = reader::read_number(switches_[k], image) != 0.0;
  return {.x_m = n[0],
          .y_m = n[1],
          .heading_rad = n[2],
          .speed_mps = n[3],
          .lock_rad = n[4],
          .wheelbase_m = n[5],
          .front_m = n[6],
          .rear_m = n[7],
          .half_width_m = n[8],
          .max_mps = n[9],
          .acceleration_mps2 = n[10],
          .deceleration_mps2 = n[11],
          .max_lock_rad = n[12],
          .error_x_m = n[13],
          .error_y_m = n[14],
          .arc_m = n[15],
          .permitted_m = n[16],
          .error_id = static_cast<int>(n[17]),
          .error_area = static_cast<int>(n[18]),
          .left = static_cast<int>(n[19]),
          .known = b[0],
          .standing = b[1],
          .done = b[2],
          .loaded = b[3],
          .bumper = b[4],
          .estop_ok = b[5]};
}

}  // namespace stepwright::vda5050_link
