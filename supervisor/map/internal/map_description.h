#pragma once

// Description of a map (map.yaml), read as ROS map_server defines it (wiki.ros.org/map_server, section 2.2).
// A pure function; any thread.

#include <filesystem>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/geometry/point.h"

namespace stepwright::fleet::internal {

struct MapDescription {
  std::string image;
  double resolution_m = 0.0;
  geometry::Point origin;
  bool negate = false;
  double occupied_thresh = 0.0;
  double free_thresh = 0.0;
};

// `file` names the text in diagnostics.
[[nodiscard]] result::Result<MapDescription> read_description(std::string_view text, const std::string& file);

}  // namespace stepwright::fleet::internal
