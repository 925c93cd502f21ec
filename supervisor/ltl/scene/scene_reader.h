#pragma once

// The floor of a scene as a file: a GeoJSON FeatureCollection of polygons, each with the properties "kind"
// (border, obstacle, proposition) and "name", in metres.
//
// Functions without state; any thread. The text is not trusted; all that is wrong is said at once. What
// outlines are worth is for make_regions() to say.
//
//   auto floor = read_scene(text, "hall.geojson");
//   if (!floor) print(to_string(floor.error()));

#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/regions/make_regions.h"

namespace stepwright::ltl {

enum class Border : std::uint8_t { InTheScene, FromElsewhere };

// L0401: no JSON; L0402: a member that is missing or of the wrong kind, "type" among them; L0403: a
// coordinate out of range; L0404: a polygon that is not closed; L0201: fewer than three points; L0405: a name
// that is used twice, of a place or of a member. `into` has what the scene is added to: its border, if that
// is from elsewhere.
[[nodiscard]] result::Result<Floor> read_scene(std::string_view text, const std::string& file,
                                               Floor into = {}, Border border = Border::InTheScene);

}  // namespace stepwright::ltl
