#pragma once

// The object "fleet" of the plan document: the report of a plan with where vehicles and loads are by now
// (supervisor/doc/fleet_executive.md lists its keys). A pure function.
//
//   record.fleet = fleet_document({.prepared = &plan, .follow = &follow, .ledger = &ledger, ...});

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/executive/fleet_follow.h"
#include "supervisor/fleet/executive/fleet_ledger.h"
#include "supervisor/fleet/executive/fleet_request.h"
#include "supervisor/fleet/prepare/prepare_fleet.h"

namespace stepwright::fleet {

struct DocumentInput {
  const PreparedFleet* prepared = nullptr;  // none of these is null
  const FleetFollow* follow = nullptr;
  const FleetLedger* ledger = nullptr;
  const std::vector<Blocked>* blocked = nullptr;
  double epoch_s = 0.0;        // scan-clock time of the schedule's time zero
  double first_epoch_s = 0.0;  // of the first plan's
  std::uint32_t revision = 1;
};

std::string fleet_document(const DocumentInput& input);

}  // namespace stepwright::fleet
