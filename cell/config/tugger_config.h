#pragma once

// The part of [plant] that a tugger train in a hall needs:
//
//   [plant]
//   kind = "tugger"
//   scene = "hall.geojson"    # polygons: border, obstacles, places (supervisor/doc/ltl.md)
//   map = "map.yaml"          # of ROS: what is not free is a wall. The scene, where there is one, has places
//                             # and obstacles, and no border then
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
//   [plant.drive]             # what the drive can do; defaults as here
//   top_speed_m_s = 2.0       # forward and in reverse
//   time_constant_s = 0.3     # of its controller
//   acceleration_m_s2 = 1.0   # with `most_trailers` trailers; with fewer the train is faster
//   braking_m_s2 = 2.0        # of the controller, likewise
//   spring_brake_m_s2 = 2.5   # that holds while the drive is not enabled
//   tractor_kg = 300.0
//   trailer_kg = 150.0        # each
//   [plant.steering]
//   full_lock_rad = 1.0
//   time_constant_s = 0.15
//   rate_rad_s = 1.0
//   [plant.slip]              # how the ground is left
//   drive_slip = 0.01         # part of the wheels' speed that the tractor does not make
//   understeer_s2_m2 = 0.01   # curvature / (1 + k v^2)
//   hitch_slip_s2_m2 = 0.005  # trailers run wider by k v^2
//   [plant.noise]             # standard deviations; none at all with uncertainty = false
//   position_m = 0.01
//   heading_rad = 0.002
//   speed_m_s = 0.01
//   hitch_rad = 0.002
//   [[plant.blockages]]       # stand in the way while the fault block_1, block_2, ... holds
//   x_m = 30.0
//   y_m = 5.0
//   length_m = 2.0            # along heading_deg
//   width_m = 1.0
//
// Thread-safe: pure.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cell/config/place_config.h"

namespace stepwright::config {

struct TrainConfig {
  double wheelbase_m = 1.0;
  double hitch_m = 1.0;
  double length_m = 0.9;
  double width_m = 0.5;
  double spacing_m = 1.0;
  // Of each figure by its key; of the table, where the file does not name the figure.
  std::map<std::string, result::Location, std::less<>> where{};
};

// Defaults are those of plant_models/assemblies/tugger_parameters.h, which says what each one is.
struct TuggerDriveConfig {
  double top_speed_m_s = 2.0;
  double time_constant_s = 0.3;
  double acceleration_m_s2 = 1.0;
  double braking_m_s2 = 2.0;
  double spring_brake_m_s2 = 2.5;
  double tractor_kg = 300.0;
  double trailer_kg = 150.0;
};

struct TuggerSteeringConfig {
  double full_lock_rad = 1.0;
  double time_constant_s = 0.15;
  double rate_rad_s = 1.0;
};

struct TuggerSlipConfig {
  double drive_slip = 0.01;
  double understeer_s2_m2 = 0.01;
  double hitch_slip_s2_m2 = 0.005;
};

struct TuggerNoiseConfig {
  double position_m = 0.01;
  double heading_rad = 0.002;
  double speed_m_s = 0.01;
  double hitch_rad = 0.002;
};

struct TuggerPlantConfig {
  std::filesystem::path scene;  // empty: of a map without places
  std::filesystem::path map;    // empty: the scene has the border
  std::size_t trailers = 5;
  std::size_t most_trailers = 5;
  result::Location most_where;  // of what says how many there can be
  double scanner_m = 2.5;
  PlaceConfig start;
  TrainConfig train;
  TuggerDriveConfig drive;
  TuggerSteeringConfig steering;
  TuggerSlipConfig slip;
  TuggerNoiseConfig noise;
  std::vector<BlockageConfig> blockages;
};

// Errors are reported to the document of `plant`. Relative paths are taken from `folder`.
TuggerPlantConfig read_tugger_plant(const settings::TomlTable& plant, const std::filesystem::path& folder);

}  // namespace stepwright::config
