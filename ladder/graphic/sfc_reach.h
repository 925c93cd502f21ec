#pragma once

// Steps that can never become active and transitions that can never fire. Internal to this folder.

#include <string>

#include "ladder/graphic/marking_graph.h"

namespace stepwright::graphic {

// "'T1'", or "A + B -> C" where it has no name.
std::string transition_label(const SfcChart& chart, std::uint32_t index);

// W0701 and W0702 where the trouble begins; what follows from it is not reported again. A graph that is not
// complete gives what holds in any case: that all steps before it are reached is then all that a transition
// needs. `net` and `graph` are those of the whole chart.
void find_unreachable(const SfcChart& chart, const TokenNet& net, const MarkingGraph& graph,
                      result::Diagnostics& out);

}  // namespace stepwright::graphic
