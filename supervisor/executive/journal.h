#pragma once

// Journal of a run, from which a restarted supervisor goes on with the plan that the controller still
// executes: the plan, where it started, the tare, what was changed from outside, and the record so far.
//
// Threads: any; both functions wait for the disk.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/executive/planning_service.h"
#include "supervisor/run/journal.h"

namespace stepwright::executive {

struct Journal : run::Journal {
  StartState start;
  model::Plan plan;                       // actions and orderings only
  std::map<std::string, double> changed;  // fluents set from outside
  bool held = false;                      // an operator wants it to be
  bool known = false;                     // the sensors have their tare
  model::NamedState seen;                 // of the plant, as the planner counts
};

// Returns once it is on the disk; fails with X0004.
[[nodiscard]] result::Result<void> write_journal(const std::filesystem::path& file, const Journal& journal);
// Nothing if there is no file; fails with X0001 if there is one that is no journal or contradicts itself.
[[nodiscard]] result::Result<std::optional<Journal>> read_journal(const std::filesystem::path& file);

}  // namespace stepwright::executive
