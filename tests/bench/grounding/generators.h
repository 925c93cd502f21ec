#pragma once

// Instances for the grounding benchmark, by number of objects. Every text is the same for the same number.

#include <string>
#include <vector>

#include "supervisor/pddl/task/task.h"

namespace stepwright::bench::grounding {

struct Instance {
  std::string name;
  std::string domain;
  std::string problem;
};

using Generator = Instance (*)(int objects);

// A chain of places, one truck for every 50 packages, roads between neighbours; the packages wait at few
// places, so that the operators grow with the objects times the places that can be reached.
Instance logistics(int objects);

// A grid of cells and a robot that pushes nothing: move along neighbours. Three parameters, few matches.
Instance grid(int objects);

// Towers of blocks: the operators grow with the square of the objects.
Instance blocks(int objects);

// Tanks with levels and vehicles that carry fixed amounts, as the bench: numeric preconditions.
Instance tanks(int objects);

// A chain of switches whose power is derived: axioms.
Instance power(int objects);

std::vector<Generator> generators();

}  // namespace stepwright::bench::grounding
