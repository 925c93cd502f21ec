#pragma once

// Expectations of the plant while an action of a plan runs, and when it is done, whatever the actions beside
// it are doing. Private to supervisor/translate.
//
// Pure function.

#include <set>
#include <string>
#include <vector>

#include "supervisor/translate/translation.h"

namespace stepwright::translate::internal {

struct Expectation {
  model::NamedState during;         // what nothing changes while it runs
  model::NamedState after;          // what it has changed when it is done
  std::set<std::string> own;        // atoms that it changes
  std::set<std::string> elsewhere;  // atoms that actions beside it change
};

// Of each action. `own` and `elsewhere` count a group of facts (OneOf) as one: a vehicle on its way passes
// places that it neither comes from nor goes to.
std::vector<Expectation> expectations(const Translation& translation, const model::PlannedRun& run,
                                      const Binding& binding);

}  // namespace stepwright::translate::internal
