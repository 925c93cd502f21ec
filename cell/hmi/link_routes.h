#pragma once

// The lines between boxes that stand in columns and rows: each leaves its box on the right and reaches the
// other one on the left. No two lines run upon each other, and none behind a box: each has places of its own
// at the boxes, a track of its own in the space between two columns and, past other boxes, one between two
// rows (channel routing: Hashimoto, Stevens, "Wire routing by optimizing channel assignment within large
// apertures", 1971).
//
// A pure function; any thread.
//
//   const LinkRoutes routes = route_links(components::lay_out(model), model.links, sizes);
//   routes.ways[link];                     // corners, from the one box to the other
//   routes.left[column], routes.top[row];  // where the boxes stand

#include <vector>

#include "plant_models/components/layout.h"

namespace stepwright::hmi {

struct Corner {
  double x = 0.0, y = 0.0;
};

struct BoxSizes {
  double box_width = 0.0;
  std::vector<double> row_height;  // by row: at least; more where many lines end
  double edge = 20.0;              // around the drawing
};

// Lengths in units of the drawing, y downwards.
struct LinkRoutes {
  std::vector<double> left;               // by column
  std::vector<double> top, height;        // by row
  double width = 0.0, whole = 0.0;        // of the drawing
  std::vector<std::vector<Corner>> ways;  // by link
};

LinkRoutes route_links(const components::Layout& layout, const std::vector<components::ModelLink>& links,
                       const BoxSizes& sizes);

}  // namespace stepwright::hmi
