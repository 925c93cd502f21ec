#pragma once

// Journal of a fleet, from which a restarted supervisor goes on: not the plan, but all that it was made of.
// The same request gives the same plan, and so the program that the runtime still has; what vehicles have
// done since shows in its image.
//
// Threads: any; both functions wait for the disk.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/executive/fleet_ledger.h"
#include "supervisor/fleet/executive/fleet_planning.h"
#include "supervisor/fleet/executive/fleet_request.h"
#include "supervisor/run/journal.h"

namespace stepwright::fleet {

// The record is kept without the fleet's document.
struct FleetJournal : run::Journal {
  LedgerState ledger;    // when the plan was made
  FleetRequest request;  // of the plan
  std::vector<Blocked> blocked = {};
  double first_epoch_s = 0.0;
  double epoch_s = 0.0;
};

// X0004: the file cannot be written.
[[nodiscard]] result::Result<void> write_fleet_journal(const std::filesystem::path& file,
                                                       const FleetJournal& journal);
// Nothing if there is no file; X0001 if there is one that is no journal.
[[nodiscard]] result::Result<std::optional<FleetJournal>> read_fleet_journal(
    const std::filesystem::path& file);

}  // namespace stepwright::fleet
