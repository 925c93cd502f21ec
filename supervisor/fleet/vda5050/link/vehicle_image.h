#pragma once

// One vehicle in the image of a fleet's program (supervisor/doc/fleet_program.md).
//
// Immutable once made; any thread.
//
//   const auto tags = VehicleTags::find(program, "v1");
//   if (tags) { const VehicleImage seen = tags->read(image); }

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "runtime/bytecode/reader/program_info.h"
#include "supervisor/fleet/vda5050/link/fleet_document.h"

namespace stepwright::vda5050_link {

struct VehicleImage {
  double x_m = 0.0;  // by odometry and navigation; of no meaning before `known`
  double y_m = 0.0;
  double heading_rad = 0.0;
  double speed_mps = 0.0;
  double lock_rad = 0.0;
  double wheelbase_m = 0.0;
  double front_m = 0.0;  // of the outline, from the reference point
  double rear_m = 0.0;
  double half_width_m = 0.0;
  double max_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double deceleration_mps2 = 0.0;
  double max_lock_rad = 0.0;
  double error_x_m = 0.0;  // where it stood when it failed
  double error_y_m = 0.0;
  double arc_m = 0.0;        // how far it has come along its path
  double permitted_m = 0.0;  // up to where it may
  int error_id = 0;
  int error_area = 0;
  int left = 0;  // polygons that it has left
  bool known = false;
  bool standing = false;
  bool done = false;
  bool loaded = false;
  bool bumper = false;
  bool estop_ok = false;
};

// Data of the vehicle for a plan.
VehicleData data_of(const VehicleImage& seen);

class VehicleTags {
 public:
  // Nothing where the program lacks one of them: it is none of a fleet with this vehicle.
  static std::optional<VehicleTags> find(const reader::ProgramInfo& program, const std::string& variable);

  VehicleImage read(std::span<const std::byte> image) const;

 private:
  static constexpr std::size_t kNumbers = 20;
  static constexpr std::size_t kSwitches = 6;
  std::array<reader::Variable, kNumbers> numbers_;
  std::array<reader::Variable, kSwitches> switches_;
};

}  // namespace stepwright::vda5050_link
