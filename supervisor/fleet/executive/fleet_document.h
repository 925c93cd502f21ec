#pragma once

// The object "fleet" of the plan document: the report of a plan with where vehicles and loads are by now
// (supervisor/doc/fleet_executive.md lists its keys). What stays as long as the plan does is made once: it is
// nearly all of it. Pure functions.
//
//   const std::string plan = plan_document(prepared, problem);
//   record.details[kFleetDetails] = fleet_document({.plan = &plan, .follow = &follow, ...});

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/executive/fleet_follow.h"
#include "supervisor/fleet/executive/fleet_ledger.h"
#include "supervisor/fleet/executive/fleet_request.h"
#include "supervisor/fleet/prepare/prepare_fleet.h"

namespace stepwright::fleet {

// Its name among the details of a run's record.
inline constexpr const char* kFleetDetails = "fleet";

struct DocumentInput {
  const std::string* plan = nullptr;  // of plan_document; none of these is null
  const FleetFollow* follow = nullptr;
  const FleetLedger* ledger = nullptr;
  const std::vector<Blocked>* blocked = nullptr;
  std::vector<bool> shut_in = {};  // by vehicle: it cannot leave where it stands
  double epoch_s = 0.0;            // scan-clock time of the schedule's time zero
  double first_epoch_s = 0.0;      // of the first plan's
  std::uint32_t revision = 1;
};

// The object without what changes while the plan is driven.
std::string plan_document(const PreparedFleet& prepared, const MissionProblem& problem);
std::string fleet_document(const DocumentInput& input);

}  // namespace stepwright::fleet
