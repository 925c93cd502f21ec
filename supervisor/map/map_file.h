#pragma once

// Maps as files: the map.yaml of ROS (map_server) and the image that it names, PGM (P2, P5) or PNG.
//
// Functions without state; any thread. The files are not trusted: sizes are bounded, and what is wrong is
// said with file, line and column (supervisor/doc/fleet_paths.md lists keys and codes). What is neither
// surely free nor surely occupied counts as blocked.
//
//   const auto floor = read_map("mine/map.yaml");
//   if (!floor) std::cerr << to_string(floor.error());

#include <filesystem>

#include "runtime/ground/result/result.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

// Fails with F0101 (file cannot be read or is too large), F0102 (YAML), F0103 (keys and their values) or
// F0104 (image).
[[nodiscard]] result::Result<OccupancyGrid> read_map(const std::filesystem::path& yaml);

// Writes YAML and, beside it, NAME.pgm; read_map gives the same grid again. Fails with F0105.
[[nodiscard]] result::Result<void> write_map(const OccupancyGrid& grid, const std::filesystem::path& yaml);

}  // namespace stepwright::fleet
