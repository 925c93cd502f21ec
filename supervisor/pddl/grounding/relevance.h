#pragma once

// Relevance of facts and variables, those that decide anything; and the fluents that merely add up in the
// metric.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/grounding/raw_task.h"

namespace stepwright::pddl {

struct Relevance {
  std::vector<bool> facts;
  std::vector<bool> variables;
  std::vector<bool> kept;  // variables that decide something even while their value stays: an effect on them
                           // can be undefined
  std::vector<double> weights;  // of the accumulated fluents in the metric; 0 for all others
};

Relevance find_relevance(const RawTask& raw);

}  // namespace stepwright::pddl
