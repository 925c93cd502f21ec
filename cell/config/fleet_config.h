#pragma once

// The part of [plant] that a floor with forklifts needs:
//
//   [plant]
//   kind = "fleet"
//   map = "map.yaml"          # of ROS; what is not free is a wall. Without it the floor is empty
//   lift_s = 2.0              # of the forks, up or down
//   [[plant.vehicles]]        # v1, v2, ...
//   x_m = 12.0
//   y_m = 5.0
//   heading_deg = 90.0
//   [[plant.pallets]]         # p1, p2, ...; heading_deg: of its long side
//   x_m = 20.0
//   y_m = 5.0
//   load_kg = 600.0
//   [[plant.blockages]]       # stand in the way while the fault block_1, block_2, ... holds
//   x_m = 30.0
//   y_m = 5.0
//   length_m = 2.0            # along heading_deg
//   width_m = 1.0
//
// Thread-safe: pure.

#include <filesystem>
#include <vector>

#include "cell/config/place_config.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct PalletConfig {
  PlaceConfig place;
  double load_kg = 600.0;
};

struct FleetPlantConfig {
  std::filesystem::path map;  // empty: no walls
  double lift_s = 2.0;
  std::vector<PlaceConfig> vehicles;
  std::vector<PalletConfig> pallets;
  std::vector<BlockageConfig> blockages;
};

// Errors are reported to the document of `plant`. Relative paths are taken from `folder`.
FleetPlantConfig read_fleet_plant(const settings::TomlTable& plant, const std::filesystem::path& folder);

}  // namespace stepwright::config
