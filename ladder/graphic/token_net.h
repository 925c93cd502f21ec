#pragma once

// A chart as a net of places and transitions, without names and conditions: what can happen to its tokens if
// every condition may be true or false at any time. Internal to this folder; values, use from any thread.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::graphic {

struct NetTransition {
  std::vector<std::uint32_t> sources;  // places, ascending
  std::vector<std::uint32_t> targets;
  std::uint32_t origin = 0;  // index into SfcChart::transitions
};

struct TokenNet {
  std::size_t places = 0;             // place i is step i of the chart
  std::vector<std::uint32_t> marked;  // initially
  std::vector<NetTransition> transitions;
  std::vector<bool> busy;  // places that a transition leads from and back to, which was melted away
};

// Requires a sound chart. A transition that another one with the condition TRUE always shuts out is left out:
// it never fires.
TokenNet token_net(const SfcChart& chart);

// The net with everything melted together that cannot change an answer: chains of steps, parallel branches
// without inner life, transitions twice (the reductions of T. Murata, "Petri nets: properties, analysis and
// applications", Proc. IEEE 77, 1989, section V: they preserve liveness and safeness). Places keep their
// numbers; a chain is represented by its last step.
TokenNet reduced(TokenNet net);

}  // namespace stepwright::graphic
