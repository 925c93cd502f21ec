#include "supervisor/fleet/report/fleet_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "supervisor/fleet/mission/explain_schedule.h"

namespace stepwright::fleet {

namespace {

using nlohmann::json;

constexpr double kDegrees = 57.29577951308232;
constexpr std::int64_t kHorizon = 100'000'000;

// To a tenth of a millimetre: what is more is noise and bytes.
double rounded(double metres) {
  return std::round(metres * 1e4) / 1e4;
}

const char* name_of_stop(StopKind kind) {
  switch (kind) {
    case StopKind::PickUp:
      return "pick_up";
    case StopKind::SetDown:
      return "set_down";
    case StopKind::Park:
      return "park";
    case StopKind::GiveWay:
      return "give_way";
  }
  return "park";
}

json bounds_json(const Bounds& bounds) {
  json pair = {bounds.least.count(), bounds.most.count()};
  if (bounds.most.count() >= kHorizon) pair[1] = nullptr;
  return pair;
}

json path_json(const FleetAnswer& answer, std::size_t v) {
  const VehicleMission& mission = answer.plan.missions[v];
  json poses = json::array();
  for (const geometry::PathPose& at : mission.path) {
    poses.push_back({rounded(at.pose.x_m), rounded(at.pose.y_m), rounded(at.pose.heading_rad * kDegrees)});
  }
  json stops = json::array();
  const auto& made = answer.plan.schedule;
  for (std::size_t k = 0; k < mission.stops.size(); ++k) {
    const Stop& stop = mission.stops[k];
    json one = {{"kind", name_of_stop(stop.kind)},
                {"location", stop.location},
                {"amount", stop.amount},
                {"aboard", stop.aboard},
                {"arc_m", rounded(stop.arc_m)},
                {"service_ms", stop.service.count()},
                {"polygon", mission.grown.stands[k]}};
    if (!stop.goal.empty()) one["goal"] = stop.goal;
    if (!made.earliest.empty()) one["end_ms"] = made.earliest[v][mission.grown.stands[k]].exit.count();
    stops.push_back(std::move(one));
  }
  return {{"vehicle", mission.vehicle},
          {"length_m", mission.path.empty() ? 0.0 : rounded(mission.path.back().arc_m)},
          {"stops", std::move(stops)},
          {"poses_m_m_deg", std::move(poses)}};
}

json polygons_json(const FleetAnswer& answer, std::size_t v) {
  const VehicleMission& mission = answer.plan.missions[v];
  const auto& made = answer.plan.schedule;
  json all = json::array();
  const auto& polygons = mission.grown.envelope.polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    json corners = json::array();
    for (const geometry::Point p : polygons[k].area.corners())
      corners.push_back({rounded(p.x_m), rounded(p.y_m)});
    json one = {{"corners_m", std::move(corners)}, {"stay_ms", bounds_json(polygons[k].stay)}};
    if (k < mission.grown.visits.size()) {
      one["way_m"] = {rounded(mission.grown.visits[k].entry_m), rounded(mission.grown.visits[k].exit_m)};
    }
    if (k + 1 < polygons.size()) one["overlap_ms"] = bounds_json(polygons[k].overlap);
    if (!made.earliest.empty()) {
      one["earliest_ms"] = {made.earliest[v][k].entry.count(), made.earliest[v][k].exit.count()};
      one["latest_ms"] = {made.latest[v][k].entry.count(), made.latest[v][k].exit.count()};
    }
    all.push_back(std::move(one));
  }
  return {{"vehicle", mission.vehicle}, {"polygons", std::move(all)}};
}

json at_json(const FleetPlan& plan, PolygonRef at) {
  return {{"vehicle", plan.missions[at.vehicle].vehicle}, {"polygon", at.polygon}};
}

const char* name_of(AllocationVerdict verdict) {
  switch (verdict) {
    case AllocationVerdict::Optimal:
      return "optimal";
    case AllocationVerdict::Feasible:
      return "feasible";
    case AllocationVerdict::Infeasible:
      return "infeasible";
    case AllocationVerdict::Exhausted:
      return "exhausted";
    case AllocationVerdict::Cancelled:
      return "cancelled";
  }
  return "exhausted";
}

json allocation_json(const FleetAnswer& answer, const MissionProblem& problem) {
  json trips = json::array();
  for (const VehicleMission& mission : answer.plan.missions) {
    for (const Stop& stop : mission.stops) {
      if (stop.kind != StopKind::SetDown) continue;
      trips.push_back({{"vehicle", mission.vehicle}, {"goal", stop.goal}, {"amount", stop.amount}});
    }
  }
  json found = {{"trips", std::move(trips)}, {"goals", problem.goals.size()}};
  if (answer.allocation) {
    found["verdict"] = name_of(answer.allocation->verdict);
    found["makespan_ms"] = answer.allocation->makespan.count();
    found["travel_ms"] = answer.allocation->travel.count();
  }
  return found;
}

void add_figures(const FleetAnswer& answer, json& report) {
  const FleetFigures& f = answer.figures;
  report["allocation_ms"] = f.allocation_ms;
  report["paths_ms"] = f.paths_ms;
  report["envelopes_ms"] = f.envelopes_ms;
  report["schedule_ms"] = f.schedule_ms;
  report["repair_ms"] = f.repair_ms;
  report["improve_ms"] = f.improve_ms;
  report["total_ms"] = f.total_ms;
  report["path_searches"] = f.searches;
  report["alternatives"] = f.alternatives;
}

void add_schedule(const FleetPlan& plan, json& report) {
  const Schedule& made = plan.schedule;
  report["conflicts"] = json::array();
  for (const SpatialPair& pair : made.conflicts) {
    report["conflicts"].push_back({at_json(plan, pair.a), at_json(plan, pair.b)});
  }
  report["precedences"] = json::array();
  for (const Precedence& order : made.precedences) {
    report["precedences"].push_back(
        {{"first", at_json(plan, order.first)}, {"second", at_json(plan, order.second)}});
  }
  report["waits"] = json::array();
  report["makespan_ms"] = nullptr;
  if (made.earliest.empty()) return;
  std::chrono::milliseconds end{0};
  for (const VehicleTimes& times : made.earliest) end = std::max(end, times.back().exit);
  report["makespan_ms"] = end.count();
  for (const Wait& wait : waits_of(plan)) {
    report["waits"].push_back({{"vehicle", plan.missions[wait.waiting].vehicle},
                               {"for", plan.missions[wait.first].vehicle},
                               {"polygon", wait.polygon},
                               {"x_m", rounded(wait.place.x_m)},
                               {"y_m", rounded(wait.place.y_m)},
                               {"from_ms", wait.from.count()},
                               {"until_ms", wait.until.count()}});
  }
}

json objective_json(const Schedule& made) {
  if (made.verdict != Verdict::Scheduled) return nullptr;
  return {{"objective_ms", made.objective.count()},
          {"lower_bound_ms", made.lower_bound.count()},
          {"proved_optimal", made.proved_optimal}};
}

json proof_json(Proof proof) {
  switch (proof) {
    case Proof::None:
      return nullptr;
    case Proof::ThisAllocation:
      return "this_allocation";
    case Proof::PathsFound:
      return "paths_found";
    case Proof::AllPaths:
      return "all_paths";
  }
  return nullptr;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Scheduled:
      return "scheduled";
    case Verdict::Infeasible:
      return "infeasible";
    case Verdict::Exhausted:
      return "exhausted";
    case Verdict::Cancelled:
      return "cancelled";
  }
  return "exhausted";
}

std::string fleet_json(const FleetAnswer& answer, const MissionProblem* problem,
                       std::optional<double> retime_ms) {
  json report = {
      {"verdict", name_of(answer.verdict)}, {"proof", proof_json(answer.proof)}, {"reason", answer.reason}};
  report["allocation"] = problem != nullptr ? allocation_json(answer, *problem) : json(nullptr);
  report["paths"] = json::array();
  report["polygons"] = json::array();
  std::size_t polygons = 0;
  for (std::size_t v = 0; v < answer.plan.missions.size(); ++v) {
    report["paths"].push_back(path_json(answer, v));
    report["polygons"].push_back(polygons_json(answer, v));
    polygons += answer.plan.missions[v].grown.envelope.polygons.size();
  }
  report["polygon_count"] = polygons;
  add_schedule(answer.plan, report);
  report["bounds"] = objective_json(answer.plan.schedule);
  report["changed_paths"] = json::array();
  for (const PathChange& change : answer.changes) {
    json around = json::array();
    for (const std::uint32_t v : change.around) around.push_back(answer.plan.missions[v].vehicle);
    report["changed_paths"].push_back({{"vehicle", answer.plan.missions[change.vehicle].vehicle},
                                       {"around", std::move(around)},
                                       {"longer_m", rounded(change.longer_m)}});
  }
  report["ways_given"] = json::array();
  for (const GaveWay& move : answer.gave_way) {
    report["ways_given"].push_back({{"vehicle", answer.plan.missions[move.vehicle].vehicle},
                                    {"x_m", rounded(move.place.x_m)},
                                    {"y_m", rounded(move.place.y_m)}});
  }
  add_figures(answer, report);
  report["retime_ms"] = retime_ms ? json(*retime_ms) : json(nullptr);
  return report.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace stepwright::fleet
