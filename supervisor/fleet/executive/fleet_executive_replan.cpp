// From a cause to the next plan: to rest, the problem of what remains, its missions.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"
#include "supervisor/fleet/executive/lead_in.h"
#include "supervisor/fleet/executive/standing.h"

namespace stepwright::fleet {

using run::IncidentKind;
using run::Phase;
using run::Response;
using std::chrono::milliseconds;

NewStart FleetExecutive::start_of(std::uint32_t v, const OccupancyGrid& map) const {
  const Track& track = tracks_[v];
  const geometry::Footprint outline =
      with_reserve(planning_.model(v), planning_.options().reserve).footprint();
  if (distance_from_way(track, reading_.vehicles[v].pose) > kBesideWay_m) return {.start = {}, .able = false};
  for (LeadIn& way : lead_ins(track.path, track.arc_m, map.frame())) {
    if (!is_free(way.path, outline, map)) continue;
    NewStart start{.start = way.start};
    if (way.path.size() > 1) start.lead_in = std::move(way.path);
    return start;
  }
  return {.start = {}, .able = false};
}

// Vehicles that find no way out of where they stand take no part in this plan, and may in the next one.
FleetRequest FleetExecutive::next_request() {
  FleetRequest request{.rest = {.elapsed = first_clock(), .starts = {}}, .cancel = &abort_};
  request.revision = revision_ + 1;
  for (const auto& lost : standing_) {
    if (lost) request.standing.push_back(*lost);
  }
  for (const Blocked& place : blocked_) request.blocked.push_back(place.area);
  const OccupancyGrid map = planning_.floor_with(request.standing, request.blocked);
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    const bool lost = ledger_.vehicles()[v].lost;
    request.rest.starts.push_back(lost ? NewStart{.start = {}, .able = false} : start_of(v, map));
    if (lost || request.rest.starts.back().able) continue;
    const geometry::Pose& pose = reading_.vehicles[v].pose;
    add_evidence(fmt::format("{} cannot leave where it stands, ({:.1f} m, {:.1f} m)",
                             planning_.problem().vehicles[v].name, pose.x_m, pose.y_m));
    request.standing.push_back({v, pose, place_around(pose, planning_.model(v).footprint(), 0.05, 0.05)});
  }
  std::ranges::sort(request.standing, {}, &Standing::vehicle);
  return request;
}

// What cannot be planned is no end while all vehicles stand: people can take an order back, open a place,
// bring a vehicle back.
bool FleetExecutive::plan_from_rest() {
  auto begin = std::chrono::steady_clock::now();
  const auto wait_for_people = [&](const std::string& reason, IncidentKind kind) {
    const bool goes_on = stay(reason, kind) && bring_to_rest();
    begin = std::chrono::steady_clock::now();
    return goes_on;
  };
  while (true) {
    const FleetRequest request = next_request();
    if (request.standing.size() == reading_.vehicles.size()) {
      if (!wait_for_people("no vehicle is left that can drive", IncidentKind::FailedActuator)) return false;
      continue;
    }
    auto outcome = planning_.plan(ledger_, request);
    if (abort_) return give_up_aborted();
    if (!outcome) {
      if (!wait_for_people("no program could be made: " + result::to_string(outcome.error()),
                           IncidentKind::ProgramFault))
        return false;
      continue;
    }
    if (outcome->prepared.program) {
      for (const std::string& name : outcome->rest.unbound)
        add_evidence("'" + name + "' does not bind: what it counts from will not happen");
      for (const GaveWay& move : outcome->prepared.answer.gave_way) {
        add_evidence(fmt::format("{} gives way to others first, at ({:.1f} m, {:.1f} m)",
                                 planning_.problem().vehicles[move.vehicle].name, move.place.x_m,
                                 move.place.y_m));
      }
      record_.incidents.back().replan_ms =
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      ++revision_;
      return launch(*std::move(outcome), request);
    }
    if (relax(*outcome)) continue;
    if (!wait_for_people("there is no plan for what remains: " + outcome->reason, IncidentKind::Position))
      return false;
  }
}

// Gives up what keeps the rest from being done; false if there is nothing more to give up. What was given up
// is no part of the next plan, so that this comes to an end.
bool FleetExecutive::relax(const FleetOutcome& outcome) {
  const MissionProblem& problem = ledger_.problem();
  bool less = false;
  for (const NoWay& part : outcome.no_way_to) {
    const std::string& name = problem.goals[part.goal].name;
    if (part.aboard_of) {
      const std::string& carrier = problem.vehicles[*part.aboard_of].name;
      less |= ledger_.keep_aboard(*part.aboard_of, part.goal, carrier + " finds no way there");
      add_evidence("'" + name + "' stays aboard of " + carrier + ": it finds no way there");
    } else {
      less |= ledger_.give_up(part.goal, "no vehicle finds a way");
      add_evidence("'" + name + "' is given up: no vehicle finds a way");
    }
  }
  for (const std::size_t k : outcome.no_way_to_task) {
    less |= ledger_.give_up_task(k);
    add_evidence("'" + problem.tasks[k].name + "' of " + problem.vehicles[problem.tasks[k].vehicle].name +
                 " is given up: no way there");
  }
  if (less) return true;
  if (outcome.prepared.answer.verdict != fleet::Verdict::Infeasible) return false;
  const std::vector<std::string> limits = ledger_.drop_limits();
  if (limits.empty()) return false;
  add_evidence("not to be kept any more: " + run::sentence_of(limits));
  return true;
}

bool FleetExecutive::launch(FleetOutcome outcome, const FleetRequest& request) {
  const bool first = record_.episodes.empty();
  if (!bring_to_run([&] { return install(outcome.prepared); })) return false;
  epoch_s_ = clock_.now_s();
  if (first) first_epoch_s_ = epoch_s_;
  launch_record(outcome);
  follow_plan(std::move(outcome), request);
  if (!first) decide(Response::Replan);
  set_phase(Phase::Executing, fmt::format("driving plan {} of {} stops", record_.episodes.size(),
                                          record_.episodes.back().actions.size()));
  return true;
}

void FleetExecutive::follow_plan(FleetOutcome outcome, const FleetRequest& request) {
  FollowOptions options{.late = options_.late};
  for (const VehicleEntry& vehicle : ledger_.vehicles()) options.lost.push_back(vehicle.lost);
  follow_.emplace(outcome.prepared.answer.plan, *outcome.prepared.program, std::move(options));
  plan_ = std::move(outcome.prepared);
  plan_document_ = plan_document(*plan_, ledger_.problem());
  planned_from_ = ledger_.state();
  planned_as_ = request;
}

void FleetExecutive::launch_record(const FleetOutcome& outcome) {
  const FleetAnswer& answer = outcome.prepared.answer;
  const Schedule& made = answer.plan.schedule;
  run::Episode episode;
  if (reader_) episode.digest = digest_;
  episode.started_s = clock_.now_s();
  episode.origin = record_.episodes.empty() ? "planned" : "replanned";
  episode.first_plan_ms = answer.figures.total_ms - answer.figures.improve_ms;
  episode.optimal_plan_ms = answer.figures.total_ms;
  episode.proved_optimal = made.proved_optimal;
  const auto seconds = [](milliseconds time) { return 1e-3 * static_cast<double>(time.count()); };
  for (std::size_t v = 0; v < answer.plan.missions.size(); ++v) {
    const VehicleMission& mission = answer.plan.missions[v];
    episode.cost = std::max(episode.cost, seconds(made.earliest[v].back().exit));
    for (std::size_t k = 0; k < mission.stops.size(); ++k) {
      const Stop& stop = mission.stops[k];
      const double end_s = seconds(made.earliest[v][mission.grown.stands[k]].exit);
      const char* does = stop.kind == StopKind::PickUp    ? "pick_up"
                         : stop.kind == StopKind::SetDown ? "set_down"
                         : stop.kind == StopKind::GiveWay ? "give_way"
                                                          : "park";
      run::ActionRecord action;
      action.text = stop.goal.empty() ? fmt::format("{}: {} at {}", mission.vehicle, does, stop.location)
                                      : fmt::format("{}: {} {} {} at {}", mission.vehicle, does, stop.amount,
                                                    stop.goal, stop.location);
      action.step = fmt::format("{}.stop {}", mission.vehicle, k + 1);
      action.planned_start_s = end_s - seconds(stop.service);
      action.planned_finish_s = end_s;
      episode.actions.push_back(std::move(action));
    }
  }
  episode.planned_makespan_s = episode.cost;
  if (made.lower_bound.count() > 0) episode.bound = seconds(made.lower_bound);
  if (record_.episodes.empty()) record_.started_s = clock_.now_s();
  record_.episodes.push_back(std::move(episode));
}

// Of the incident that is being decided.
void FleetExecutive::add_evidence(std::string sentence) {
  auto& evidence = record_.incidents.back().evidence;
  if (std::ranges::find(evidence, sentence) == evidence.end()) evidence.push_back(std::move(sentence));
}

}  // namespace stepwright::fleet
