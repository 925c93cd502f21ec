#pragma once

// Parameters of a floor with forklifts, pallets, walls and places that can be blocked. Metres, seen from
// above.

#include <cstdint>
#include <vector>

#include "plant_models/assemblies/forklift.h"
#include "plant_models/assemblies/forklift_parameters.h"
#include "plant_models/body2d/body_geometry.h"

namespace stepwright::assemblies {

struct PalletParameters {
  body2d::Pose pose;  // middle of the pallet; its long side along the angle
  double load_kg = 600.0;
};

struct BlockParameters {
  body2d::Rectangle rectangle;
  body2d::Pose pose;
};

// Standard deviations; white from one step to the next.
struct FleetNoise {
  double position_m = 0.01;
  double heading_rad = 0.002;
  double speed_m_s = 0.01;

  static constexpr FleetNoise none() { return {0.0, 0.0, 0.0}; }
};

struct FleetParameters {
  ForkliftParameters forklift;       // all alike
  std::vector<ForkliftPose> starts;  // one for each vehicle, v1 first; at least one
  std::vector<PalletParameters> pallets;
  std::vector<BlockParameters> walls;
  std::vector<BlockParameters> blockages;  // stand in the way while the fault block_1, block_2, ... holds
  double lift_s = 2.0;                     // of the forks, up or down
  FleetNoise noise;
  std::uint64_t seed = 1;
};

inline constexpr double kPalletLength_m = 1.2;  // EN 13698-1
inline constexpr double kPalletWidth_m = 0.8;
// Greatest coordinate that a count of centimetres can hold.
inline constexpr double kFarthest_m = 320.0;

// Fails with one C0321 per figure that has no physical sense. Whether bodies overlap at the start is not
// looked at.
[[nodiscard]] result::Result<void> validate(const FleetParameters& parameters);

}  // namespace stepwright::assemblies
