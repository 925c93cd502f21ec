#include "supervisor/fleet/executive/fleet_document.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "supervisor/fleet/report/fleet_json.h"
#include "supervisor/fleet/schedule/sections.h"

namespace stepwright::fleet {
namespace {

using nlohmann::json;

double rounded(double metres) {
  return std::round(metres * 1e4) / 1e4;
}

json corners_json(const geometry::ConvexPolygon& area) {
  json corners = json::array();
  for (const geometry::Point p : area.corners()) corners.push_back({rounded(p.x_m), rounded(p.y_m)});
  return corners;
}

const char* name_of(GoalState state) {
  switch (state) {
    case GoalState::Waiting:
      return "waiting";
    case GoalState::Carried:
      return "carried";
    case GoalState::Delivered:
      return "delivered";
    case GoalState::GivenUp:
      break;
  }
  return "given_up";
}

json vehicles_json(const DocumentInput& input) {
  json all = json::array();
  const FleetPlan& plan = input.follow->plan();
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    const VehicleFollow& now = input.follow->vehicles()[v];
    const VehicleEntry& entry = input.ledger->vehicles()[v];
    json one = {{"vehicle", plan.missions[v].vehicle},
                {"variable", input.follow->program().missions[v].name},
                {"state", to_string(entry.lost ? DriveState::Lost : now.state)},
                {"delay_ms", now.delay.count()},
                {"arrives_ms", now.arrives.count()},
                {"stops_done", now.stops_done},
                {"error", now.error},
                {"outline_m", corners_json(footprint_at({}, plan.missions[v].model.footprint()))}};
    if (now.waits_for) one["waits_for"] = plan.missions[*now.waits_for].vehicle;
    if (!entry.why.empty()) one["reason"] = entry.why;
    all.push_back(std::move(one));
  }
  return all;
}

json goals_json(const DocumentInput& input) {
  json all = json::array();
  const MissionProblem& problem = input.ledger->problem();
  for (std::size_t k = 0; k < problem.goals.size(); ++k) {
    const MissionGoal& goal = problem.goals[k];
    const GoalEntry& entry = input.ledger->goals()[k];
    json one = {{"name", goal.name},
                {"from", problem.locations[goal.from].name},
                {"to", problem.locations[goal.to].name},
                {"amount", entry.amount},
                {"delivered", entry.delivered},
                {"state", name_of(entry.state())}};
    if (entry.vehicle) one["vehicle"] = problem.vehicles[*entry.vehicle].name;
    if (!entry.ends.empty() && entry.state() == GoalState::Delivered)
      one["delivered_ms"] = entry.ends.back().count();
    if (goal.due) one["due_ms"] = goal.due->count();
    for (const MissionConstraint& bound : problem.constraints) {
      const bool deadline = bound.from.moment == Moment::TimeZero && bound.to.moment == Moment::GoalEnd &&
                            bound.to.index == k && bound.distance.most < SpeedLimits{}.horizon;
      if (deadline) one["due_ms"] = bound.distance.most.count();
    }
    if (entry.late) one["late"] = true;
    if (!entry.why.empty()) one["reason"] = entry.why;
    all.push_back(std::move(one));
  }
  return all;
}

json sections_json(const FleetPlan& plan) {
  json all = json::array();
  const auto envelopes = envelopes_of(plan);
  const Sections sections = merge_sections(overlapping_pairs(envelopes), envelopes);
  for (const CriticalSection& section : sections.sections) {
    json polygons = json::array();
    json corners = json::array();
    const auto pairs = sections.of(section);
    for (const SpatialPair& pair : pairs) {
      for (const PolygonRef at : {pair.a, pair.b}) {
        json one = {{"vehicle", plan.missions[at.vehicle].vehicle}, {"polygon", at.polygon}};
        if (std::ranges::find(polygons, one) == polygons.end()) polygons.push_back(std::move(one));
      }
      const auto both = intersection(envelopes[pair.a.vehicle].polygons[pair.a.polygon].area,
                                     envelopes[pair.b.vehicle].polygons[pair.b.polygon].area);
      if (both) corners.push_back(corners_json(*both));
    }
    // Who leaves first at the first of its pairs.
    const SpatialPair& head = pairs.front();
    const auto& times = plan.schedule.earliest;
    const bool a_first =
        times[head.a.vehicle][head.a.polygon].exit <= times[head.b.vehicle][head.b.polygon].entry;
    json order = {plan.missions[a_first ? section.a : section.b].vehicle,
                  plan.missions[a_first ? section.b : section.a].vehicle};
    all.push_back(
        {{"polygons", std::move(polygons)}, {"corners_m", std::move(corners)}, {"order", std::move(order)}});
  }
  return all;
}

}  // namespace

std::string fleet_document(const DocumentInput& input) {
  json report = json::parse(fleet_json(input.prepared->answer, &input.ledger->problem(), std::nullopt));
  report["epoch_s"] = input.epoch_s;
  report["first_epoch_s"] = input.first_epoch_s;
  report["revision"] = input.revision;
  report["vehicles"] = vehicles_json(input);
  report["goals"] = goals_json(input);
  report["sections"] = sections_json(input.follow->plan());
  report["blocked"] = json::array();
  for (const Blocked& place : *input.blocked)
    report["blocked"].push_back({{"name", place.name}, {"corners_m", corners_json(place.area)}});
  report["retimings"] = input.follow->retimings();
  report["retime_ms"] = input.follow->slowest_retiming_ms();
  report["arrives_ms"] = input.follow->arrives().count();
  return report.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace stepwright::fleet
