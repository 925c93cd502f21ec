#pragma once

// Why a task cannot be done on a floor from where it begins: which of its parts, and what stands in the way.
// Whatever has no width is asked of the floor only, so that the answer is exact for a point: a vehicle may
// fail where a point does not.
//
// Pure functions. Example:
//   if (auto why = why_impossible(*map, *task, places, here)) std::puts(why->reason.c_str());

#include <optional>
#include <string>
#include <vector>

#include "supervisor/ltl/guide/guide.h"
#include "supervisor/ltl/guide/task.h"

namespace stepwright::ltl {

struct ImpossiblePart {
  std::string text;  // in Spot's syntax
  Place at;          // in the text of the formula
};

struct Impossible {
  // Of the conjunction that the task is: one that cannot be done alone, or so many that cannot be done
  // together although any of them can be left out for the others.
  std::vector<ImpossiblePart> parts;
  // "no way leads to 'press'", "every way leads through 'wash'", "the start is in 'wash'".
  std::string reason;
};

// Nothing if a point can do the task from that region.
std::optional<Impossible> why_impossible(const RegionMap& map, const Task& task,
                                         const std::vector<std::string>& places, std::uint32_t start);

}  // namespace stepwright::ltl
