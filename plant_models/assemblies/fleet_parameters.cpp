#include "plant_models/assemblies/fleet_parameters.h"

#include <cmath>
#include <string>

#include "plant_models/assemblies/requirements.h"

namespace stepwright::assemblies {
namespace {

constexpr std::size_t kMostVehicles = 1000;

bool on_the_floor(double x_m, double y_m, double angle_rad) {
  return std::abs(x_m) <= kFarthest_m && std::abs(y_m) <= kFarthest_m && std::isfinite(angle_rad);
}

bool on_the_floor(const body2d::Pose& pose) {
  return on_the_floor(pose.position.x, pose.position.y, pose.angle);
}

void check_blocks(const std::vector<BlockParameters>& blocks, const std::string& what, Requirements& wanted) {
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::string name = what + " " + std::to_string(k + 1);
    wanted.require(on_the_floor(blocks[k].pose), name + " lies more than 320 m from the origin");
    wanted.positive(blocks[k].rectangle.size.x, name + ": length");
    wanted.positive(blocks[k].rectangle.size.y, name + ": width");
  }
}

}  // namespace

result::Result<void> validate(const FleetParameters& p) {
  if (auto forklift = validate(p.forklift); !forklift) return forklift;
  Requirements wanted;
  wanted.require(!p.starts.empty() && p.starts.size() <= kMostVehicles, "a fleet has 1 to 1000 vehicles");
  for (std::size_t k = 0; k < p.starts.size(); ++k) {
    wanted.require(
        on_the_floor(p.starts[k].x_m, p.starts[k].y_m, p.starts[k].heading_rad),
        "vehicle v" + std::to_string(k + 1) + " starts more than 320 m from the origin",
        "position sensors count centimetres in 16 bits: move the origin into the middle of the map");
  }
  for (std::size_t k = 0; k < p.pallets.size(); ++k) {
    const std::string name = "pallet p" + std::to_string(k + 1);
    wanted.require(on_the_floor(p.pallets[k].pose), name + " lies more than 320 m from the origin");
    wanted.positive(p.pallets[k].load_kg, name + ": load_kg");
  }
  check_blocks(p.walls, "wall", wanted);
  check_blocks(p.blockages, "blockage", wanted);
  wanted.positive(p.lift_s, "lift_s");
  wanted.not_negative(p.noise.position_m, "noise: position_m");
  wanted.not_negative(p.noise.heading_rad, "noise: heading_rad");
  wanted.not_negative(p.noise.speed_m_s, "noise: speed_m_s");
  return wanted.finish();
}

}  // namespace stepwright::assemblies
