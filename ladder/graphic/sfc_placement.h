#pragma once

// Second stage of a chart's layout: the order of the nodes in their layers (few crossings) and the positions
// of their axes (straight lines, branches centred). Internal to this folder.

#include "ladder/graphic/sfc_graph.h"

namespace stepwright::graphic {

// Sorts every layer by the mean position of the neighbours, from above and from below in turn; keeps the
// order with the fewest crossings.
void order_layers(LayeredGraph& graph);

// Sets `x` of every node such that neighbours in a layer keep `gap` between their extents; the leftmost
// extent of all is at 0. Requires `left` and `right`.
void place_axes(LayeredGraph& graph, int gap);

}  // namespace stepwright::graphic
