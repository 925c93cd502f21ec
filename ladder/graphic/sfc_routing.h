#pragma once

// Third stage of a chart's layout: the lines between two layers. Internal to this folder.

#include <cstddef>
#include <vector>

#include "ladder/graphic/sfc_graph.h"

namespace stepwright::graphic {

// A horizontal line in the channel between two layers: the bar of a divergence or convergence, or a bend.
struct ChannelLine {
  int x1 = 0;
  int x2 = 0;
  bool doubled = false;         // a simultaneous branch
  std::vector<int> from_above;  // x of the lines that come down onto it from the upper layer
  std::vector<int> to_below;    // x of the lines that leave it for the lower layer
  std::size_t track = 0;        // 0 is the uppermost
};

// A vertical line from the upper layer or a channel line to another channel line or the lower layer.
struct ChannelDrop {
  static constexpr std::size_t layer = static_cast<std::size_t>(-1);
  int x = 0;
  std::size_t from = layer;  // index of a channel line, or `layer` for the upper layer
  std::size_t to = layer;
};

struct Channel {
  std::vector<ChannelLine> lines;
  std::vector<ChannelDrop> drops;
  std::size_t tracks = 0;
};

// The channel below `layer`. Requires placed axes. Lines that touch the same x are stacked such that no two
// verticals run into each other, as far as that is possible.
Channel route_channel(const LayeredGraph& graph, std::size_t layer, int overhang);

}  // namespace stepwright::graphic
