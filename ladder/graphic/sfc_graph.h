#pragma once

// A chart as a layered graph: the first stage of its layout. Internal to this folder.
//
// Steps stand in even, transitions in odd layers; every edge joins neighbouring layers, long ones run through
// nodes of kind Pass. Edges that would close a loop become nodes of kind Jump.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::graphic {

enum class NodeKind : std::uint8_t { Step, Transition, Jump, Pass };

struct LayoutNode {
  NodeKind kind = NodeKind::Pass;
  std::uint32_t index = 0;  // of the step, the transition, or the step that a Jump goes to
  std::size_t layer = 0;
  std::vector<std::size_t> up;    // neighbours in the layer above
  std::vector<std::size_t> down;  // neighbours in the layer below
  // Size around the vertical axis of the node, set by the layout.
  int left = 0;
  int right = 0;
  int height = 0;
  int x = 0;  // of the axis
};

struct LayeredGraph {
  std::vector<LayoutNode> nodes;
  std::vector<std::vector<std::size_t>> layers;        // node numbers from left to right
  std::vector<std::vector<std::uint32_t>> jumps_into;  // per step: the transitions that jump to it
};

// Requires a sound chart.
LayeredGraph layered_graph(const SfcChart& chart);

}  // namespace stepwright::graphic
