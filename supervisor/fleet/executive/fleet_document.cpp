#include "supervisor/fleet/executive/fleet_document.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "supervisor/fleet/executive/telling_poses.h"
#include "supervisor/fleet/report/fleet_json.h"
#include "supervisor/fleet/schedule/sections.h"
#include "supervisor/geometry/union_outlines.h"

namespace stepwright::fleet {
namespace {

using nlohmann::json;

double rounded(double metres) {
  return std::round(metres * 1e4) / 1e4;
}

// What is only drawn: to a centimetre.
constexpr double kDrawn_m = 0.01;
double to_drawn(double metres) {
  return std::round(metres / kDrawn_m) / std::round(1.0 / kDrawn_m);
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
    if (const std::string why = input.ledger->reason_of(k, input.shut_in); !why.empty()) one["reason"] = why;
    all.push_back(std::move(one));
  }
  return all;
}

json rings_json(const std::vector<geometry::ConvexPolygon>& pieces) {
  json rings = json::array();
  for (const auto& outline : geometry::union_outlines(pieces, kDrawn_m)) {
    json ring = json::array();
    for (const geometry::Point p : outline) ring.push_back({to_drawn(p.x_m), to_drawn(p.y_m)});
    rings.push_back(std::move(ring));
  }
  return rings;
}

json section_json(const FleetPlan& plan, const std::vector<TrajectoryEnvelope>& envelopes,
                  const CriticalSection& section, std::span<const SpatialPair> pairs) {
  json polygons = json::array();
  std::vector<geometry::ConvexPolygon> pieces;
  for (const SpatialPair& pair : pairs) {
    for (const PolygonRef at : {pair.a, pair.b}) {
      json one = {{"vehicle", plan.missions[at.vehicle].vehicle}, {"polygon", at.polygon}};
      if (std::ranges::find(polygons, one) == polygons.end()) polygons.push_back(std::move(one));
    }
    auto both = intersection(envelopes[pair.a.vehicle].polygons[pair.a.polygon].area,
                             envelopes[pair.b.vehicle].polygons[pair.b.polygon].area);
    if (both) pieces.push_back(*std::move(both));
  }
  // Who leaves first at the first of its pairs.
  const SpatialPair& head = pairs.front();
  const auto& times = plan.schedule.earliest;
  const bool a_first =
      times[head.a.vehicle][head.a.polygon].exit <= times[head.b.vehicle][head.b.polygon].entry;
  json order = {plan.missions[a_first ? section.a : section.b].vehicle,
                plan.missions[a_first ? section.b : section.a].vehicle};
  return {{"polygons", std::move(polygons)}, {"corners_m", rings_json(pieces)}, {"order", std::move(order)}};
}

json sections_json(const FleetPlan& plan) {
  json all = json::array();
  const auto envelopes = envelopes_of(plan);
  const Sections sections = merge_sections(overlapping_pairs(envelopes), envelopes);
  for (const CriticalSection& section : sections.sections)
    all.push_back(section_json(plan, envelopes, section, sections.of(section)));
  return all;
}

void thin_ways(const FleetPlan& plan, json& paths) {
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    json& poses = paths[v]["poses_m_m_deg"];
    json kept = json::array();
    for (const std::size_t k : telling_poses(plan.missions[v])) kept.push_back(std::move(poses[k]));
    poses = std::move(kept);
  }
}

std::string text_of(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string plan_document(const PreparedFleet& prepared, const MissionProblem& problem) {
  json report = json::parse(fleet_json(prepared.answer, &problem, std::nullopt));
  for (const char* key : {"conflicts", "retime_ms"}) report.erase(key);
  thin_ways(prepared.answer.plan, report["paths"]);
  report["sections"] = sections_json(prepared.answer.plan);
  return text_of(report);
}

std::string fleet_document(const DocumentInput& input) {
  json news = {{"epoch_s", input.epoch_s},
               {"first_epoch_s", input.first_epoch_s},
               {"revision", input.revision},
               {"vehicles", vehicles_json(input)},
               {"goals", goals_json(input)},
               {"blocked", json::array()},
               {"retimings", input.follow->retimings()},
               {"retime_ms", input.follow->slowest_retiming_ms()},
               {"arrives_ms", input.follow->arrives().count()}};
  for (const Blocked& place : *input.blocked)
    news["blocked"].push_back({{"name", place.name}, {"corners_m", corners_json(place.area)}});
  // The plan's object goes on with the members of this one.
  std::string text = *input.plan;
  text.back() = ',';
  return text + text_of(news).substr(1);
}

}  // namespace stepwright::fleet
