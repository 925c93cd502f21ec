#pragma once

// A plan document as a supervisor publishes it, of a made plan.

#include <nlohmann/json.hpp>
#include <string>

#include "supervisor/fleet/report/fleet_json.h"
#include "tests/support/vda5050/made_missions.h"

namespace stepwright::vda5050_link {

inline fleet::FleetPlan crossing_plan() {
  using support::MadeMission;
  return support::scheduled({MadeMission("v1", {16, 30, 0}).drive(12.0).drive(6.0, 0.15).drive(4.0).mission(),
                             MadeMission("truck 2", {30, 10, 1.5707963267948966})
                                 .drive(8.0)
                                 .stop(fleet::StopKind::PickUp, "rack", "load7")
                                 .drive(26.0)
                                 .drive(3.0, 0.0, geometry::Travel::Reverse)
                                 .stop(fleet::StopKind::SetDown, "dock", "load7")
                                 .mission()});
}

inline nlohmann::json document_of(fleet::FleetPlan plan, int revision = 1) {
  for (fleet::VehicleMission& mission : plan.missions) {
    mission.grown.stands.assign(mission.stops.size(), mission.grown.visits.size() - 1);
  }
  fleet::FleetAnswer answer;
  answer.verdict = plan.schedule.verdict;
  answer.plan = std::move(plan);
  nlohmann::json report = nlohmann::json::parse(fleet::fleet_json(answer, nullptr, std::nullopt));
  report["revision"] = revision;
  report["vehicles"] = {
      {{"vehicle", "v1"}, {"variable", "v1"}, {"state", "driving"}},
      {{"vehicle", "truck 2"}, {"variable", "truck_2"}, {"state", "waiting"}, {"stops_done", 0}}};
  return {{"phase", "executing"}, {"program_digest", "abc"}, {"fleet", report}};
}

}  // namespace stepwright::vda5050_link
