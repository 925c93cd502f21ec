#pragma once

// Cuts a floor with obstacles and propositions into regions: constrained Delaunay triangles (GEOS), with the
// outlines of obstacles and propositions as sides. Propositions may overlap one another; each region has all
// that hold in it.
//
// A pure function; any thread. Coordinates count to a micrometre: what lies closer together is one point.

#include <functional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/regions/region_map.h"

namespace stepwright::ltl {

inline constexpr const char* kStoppedRegions = "L0209";
inline constexpr std::size_t kMostCorners = 100'000;  // of a floor, in all

// A simple polygon, in either order, with its place in the file for messages.
struct Area {
  std::string name;
  std::vector<geometry::Point> ring;
  result::Location where;
};

struct Floor {
  Area border;
  std::vector<Area> obstacles;     // may touch or overlap one another and the border
  std::vector<Area> propositions;  // bit k of a label is propositions[k]; at most kMostPropositions
  // Obstacles that have come later, across propositions too: vehicles go round them, regions do not know
  // them.
  std::vector<Area> blocked{};
};

// One outline by itself: L0201, L0202, L0203. For areas that come after the floor.
[[nodiscard]] result::Result<void> check_outline(const Area& area);

// Fails with all that is wrong: L0201 (fewer than three points), L0202 (a coordinate that is no number),
// L0203 (an outline that crosses or touches itself, with the point), L0204 (a proposition outside of the
// border or meets an obstacle), L0205 (nothing is free), L0206 (too many propositions), L0207 (the
// triangulation failed).
//
// L0208: more than kMostCorners corners, with the outline where that is; L0209: `stop`, which is asked now
// and then, says that it takes too long.
[[nodiscard]] result::Result<RegionMap> make_regions(const Floor& floor,
                                                     const std::function<bool()>& stop = {});

}  // namespace stepwright::ltl
