#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

std::vector<TrajectoryEnvelope> envelopes_of(const FleetPlan& plan) {
  std::vector<TrajectoryEnvelope> envelopes;
  envelopes.reserve(plan.missions.size());
  for (const VehicleMission& mission : plan.missions) envelopes.push_back(mission.grown.envelope);
  return envelopes;
}

}  // namespace stepwright::fleet
