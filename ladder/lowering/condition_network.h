#pragma once

// Networks of LD and FBD that belong to a drawn chart, as its lowering takes them. Values.

#include <cstddef>
#include <string>
#include <vector>

#include "ladder/graphic/ladder_program.h"

namespace stepwright::lowering {

// A network that is the condition of transitions: it runs once in every scan in which one of them is enabled,
// and in no other.
struct ConditionNetwork {
  std::vector<std::size_t> transitions;  // indexes into SfcChart::transitions
  std::string statements;                // ST
};

struct ChartNetworks {
  graphic::LadderProgram every_scan;  // before the transitions are tested
  std::vector<ConditionNetwork> conditions;
};

}  // namespace stepwright::lowering
