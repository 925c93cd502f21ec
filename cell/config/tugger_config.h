#pragma once

// The part of [plant] that a tugger train in a hall needs:
//
//   [plant]
//   kind = "tugger"
//   scene = "hall.geojson"    # polygons: border, obstacles, places (supervisor/doc/ltl.md)
//   trailers = 5              # coupled at the start; 0 to 15
//   most_trailers = 8         # that can ever be coupled; default: as many as `trailers`
//   scanner_m = 2.5           # how far in front of the tractor it sees blockages
//   [plant.start]             # of the tractor's reference point; the trailers stand in line behind it
//   x_m = 12.0
//   y_m = 5.0
//   heading_deg = 90.0
//   [plant.train]             # its figures, where they are others
//   wheelbase_m = 1.0
//   hitch_m = 1.0             # from the axle in front to the trailer's own
//   length_m = 0.9            # of each link
//   width_m = 0.5
//   spacing_m = 1.0           # from the middle of a link to that of the next one
//   [[plant.blockages]]       # stand in the way while the fault block_1, block_2, ... holds
//   x_m = 30.0
//   y_m = 5.0
//   length_m = 2.0            # along heading_deg
//   width_m = 1.0
//
// Thread-safe: pure.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cell/config/place_config.h"

namespace stepwright::config {

struct TrainConfig {
  double wheelbase_m = 1.0;
  double hitch_m = 1.0;
  double length_m = 0.9;
  double width_m = 0.5;
  double spacing_m = 1.0;
};

struct TuggerPlantConfig {
  std::filesystem::path scene;
  std::size_t trailers = 5;
  std::size_t most_trailers = 5;
  double scanner_m = 2.5;
  PlaceConfig start;
  TrainConfig train;
  std::vector<BlockageConfig> blockages;
};

// Errors are reported to the document of `plant`. Relative paths are taken from `folder`.
TuggerPlantConfig read_tugger_plant(const settings::TomlTable& plant, const std::filesystem::path& folder);

}  // namespace stepwright::config
