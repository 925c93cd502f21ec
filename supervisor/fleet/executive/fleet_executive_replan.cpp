// From a cause to the next plan: to rest, the problem of what remains, its missions.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"
#include "supervisor/fleet/executive/halt_plan.h"
#include "supervisor/fleet/executive/lead_in.h"
#include "supervisor/fleet/executive/standing.h"

namespace stepwright::fleet {

using executive::IncidentKind;
using executive::Phase;
using executive::Response;
using std::chrono::milliseconds;

namespace {

constexpr double kRestWithin_s = 60.0;  // of the scan clock
constexpr double kSearch_m = 6.0;       // of the way, around where it is thought to be
constexpr double kBeside_m = 0.4;       // of the way: a vehicle that stands farther from it is not on it

std::string joined(const std::vector<std::string>& sentences) {
  return fmt::format("{}", fmt::join(sentences, "; "));
}

// Where on the path the vehicle stands, near a place of it.
double arc_near(const geometry::Path& path, double guess_m, const geometry::Pose& pose) {
  double best_m = guess_m;
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::PathPose& at : path) {
    if (std::abs(at.arc_m - guess_m) > kSearch_m) continue;
    // A place that is passed twice: the one with the vehicle's heading, then the one that is expected.
    const double turned =
        std::abs(std::remainder(at.pose.heading_rad - pose.heading_rad, 2.0 * std::numbers::pi));
    const double off = geometry::distance(at.pose.position(), pose.position()) + turned +
                       0.02 * std::abs(at.arc_m - guess_m);
    if (off >= least) continue;
    least = off;
    best_m = at.arc_m;
  }
  return best_m;
}

double distance_from(const geometry::Path& path, double arc_m, const geometry::Pose& pose) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::PathPose& at : path) {
    if (std::abs(at.arc_m - arc_m) < 0.1)
      least = std::min(least, geometry::distance(at.pose.position(), pose.position()));
  }
  return least;
}

}  // namespace

bool FleetExecutive::replan(const Cause& cause) {
  record_.replans.push_back({time_s_, joined(cause.evidence), {}});
  open_incident(cause);
  if (static_cast<int>(record_.replans.size()) > options_.max_replans) {
    return give_up(fmt::format("{} plans were not enough: {}", options_.max_replans, joined(cause.evidence)),
                   cause.kind);
  }
  set_phase(Phase::Replanning, joined(cause.evidence));
  return bring_to_rest() && plan_rest();
}

bool FleetExecutive::bring_to_rest() {
  const HaltPlan halt = halt_plan(follow_->plan(), follow_->program(), reading_,
                                  desk_.options().program.drive, desk_.problem().map.frame());
  auto prepared = desk_.program_of(halt.plan, revision_);
  if (!prepared) {
    return give_up("the fleet cannot be brought to rest: " + result::to_string(prepared.error()),
                   IncidentKind::ProgramFault);
  }
  while (!install(*prepared)) {
    if (record_.phase == Phase::Safe || !await_runtime()) return false;
  }
  return await_rest(*prepared, halt.begun_m);
}

// Who stops by himself meanwhile is lost as well. The clock stands still at the event with which all rest.
bool FleetExecutive::await_rest(const PreparedFleet& halt, const std::vector<double>& begun_m) {
  const double until_s = time_s_ + kRestWithin_s;
  while (true) {
    if (abort_) return give_up("aborted by the operator", IncidentKind::Operator);
    const auto event = controller_.wait_event(milliseconds(200));
    if (!event) {
      if (!runtime_lost()) continue;
      return give_up("the runtime was lost while the fleet was brought to rest", IncidentKind::LostRuntime);
    }
    if (event->kind == host::EventKind::Trap || event->kind == host::EventKind::Stopped ||
        event->kind == host::EventKind::RolledBack) {
      return give_up("the fleet was stopped while it was brought to rest: " + event->detail,
                     IncidentKind::ProgramFault);
    }
    if (event->program_digest == running_->digest && event->kind == host::EventKind::StepChange) {
      take_time(event->time_ns);
      reading_ = running_->reader.read(event->image);
      if (reading_.emergency_stop) return give_up("the emergency stop is pressed", IncidentKind::Operator);
      std::vector<std::uint32_t> errors;
      for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
        if (reading_.vehicles[v].error != 0 && !ledger_.vehicles()[v].lost) errors.push_back(v);
      }
      for (const std::string& sentence : lose(errors, reading_, begun_m).evidence) add_evidence(sentence);
      if (all_rest(halt)) {
        track(begun_m);
        return true;
      }
      if (time_s_ > until_s) return give_up("the fleet does not come to rest", IncidentKind::Timeout);
    }
    (void)controller_.acknowledge(event->sequence);
  }
}

bool FleetExecutive::all_rest(const PreparedFleet& halt) const {
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    const VehicleReading& now = reading_.vehicles[v];
    const MissionStepKind step = halt.program->missions[v].steps[now.step].kind;
    const bool rests = now.standing && now.forks_at_end && step == MissionStepKind::Done;
    if (!rests && !ledger_.vehicles()[v].lost) return false;
  }
  return true;
}

// Where vehicles stand on their last ways.
void FleetExecutive::track(const std::vector<double>& begun_m) {
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    if (ledger_.vehicles()[v].lost) continue;
    const VehicleReading& now = reading_.vehicles[v];
    const geometry::Path& path = plan_->answer.plan.missions[v].path;
    // Of a vehicle that was lost the plan knows a place, and no way.
    if (path.size() > 1 || tracks_[v].path.empty()) tracks_[v] = {path, begun_m[v] + now.arc_m};
    tracks_[v].arc_m = arc_near(tracks_[v].path, tracks_[v].arc_m, now.pose);
  }
}

NewStart FleetExecutive::start_of(std::uint32_t v, const OccupancyGrid& map) const {
  const Track& track = tracks_[v];
  const geometry::Footprint outline = with_reserve(desk_.model(v), desk_.options().reserve).footprint();
  if (distance_from(track.path, track.arc_m, reading_.vehicles[v].pose) > kBeside_m)
    return {.start = {}, .able = false};
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
  const OccupancyGrid map = desk_.floor_with(request.standing, request.blocked);
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    const bool lost = ledger_.vehicles()[v].lost;
    request.rest.starts.push_back(lost ? NewStart{.start = {}, .able = false} : start_of(v, map));
    if (lost || request.rest.starts.back().able) continue;
    const geometry::Pose& pose = reading_.vehicles[v].pose;
    add_evidence(fmt::format("{} cannot leave where it stands, ({:.1f} m, {:.1f} m)",
                             desk_.problem().vehicles[v].name, pose.x_m, pose.y_m));
    request.standing.push_back({v, pose, place_around(pose, desk_.model(v).footprint(), 0.05, 0.05)});
  }
  std::ranges::sort(request.standing, {}, &Standing::vehicle);
  return request;
}

bool FleetExecutive::plan_rest() {
  const auto begin = std::chrono::steady_clock::now();
  while (true) {
    const FleetRequest request = next_request();
    if (request.standing.size() == reading_.vehicles.size())
      return give_up("no vehicle is left that can drive", IncidentKind::FailedActuator);
    auto outcome = desk_.plan(ledger_, request);
    if (abort_) return give_up("aborted by the operator", IncidentKind::Operator);
    if (!outcome) {
      return give_up("no program could be made: " + result::to_string(outcome.error()),
                     IncidentKind::ProgramFault);
    }
    if (outcome->prepared.program) {
      record_.incidents.back().replan_ms =
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      ++revision_;
      return launch(*std::move(outcome), request);
    }
    if (!relax(*outcome))
      return give_up("there is no plan for what remains: " + outcome->reason, IncidentKind::Position);
  }
}

// Gives up what keeps the rest from being done; false if there is nothing more to give up.
bool FleetExecutive::relax(const FleetOutcome& outcome) {
  for (const std::size_t k : outcome.no_way_to) {
    const std::string name = ledger_.problem().goals[k].name;
    ledger_.give_up(k, "no vehicle finds a way");
    add_evidence("'" + name + "' is given up: no vehicle finds a way");
  }
  for (const std::size_t k : outcome.no_way_to_task) {
    ledger_.give_up_task(k);
    add_evidence("'" + ledger_.problem().tasks[k].name + "' of " +
                 ledger_.problem().vehicles[ledger_.problem().tasks[k].vehicle].name +
                 " is given up: no way there");
  }
  if (!outcome.no_way_to.empty() || !outcome.no_way_to_task.empty()) return true;
  if (outcome.prepared.answer.verdict != fleet::Verdict::Infeasible) return false;
  const std::vector<std::string> limits = ledger_.drop_limits();
  if (limits.empty()) return false;
  add_evidence("not to be kept any more: " + joined(limits));
  return true;
}

bool FleetExecutive::launch(FleetOutcome outcome, const FleetRequest& request) {
  const bool first = record_.episodes.empty();
  while (!install(outcome.prepared)) {
    if (record_.phase == Phase::Safe || !await_runtime()) return false;
  }
  epoch_s_ = time_s_;
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
  planned_from_ = ledger_.state();
  planned_as_ = request;
}

void FleetExecutive::launch_record(const FleetOutcome& outcome) {
  const FleetAnswer& answer = outcome.prepared.answer;
  const Schedule& made = answer.plan.schedule;
  executive::Episode episode;
  episode.digest = running_->digest;
  episode.started_s = time_s_;
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
                                                          : "park";
      executive::ActionRecord action;
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
  if (record_.episodes.empty()) record_.started_s = time_s_;
  record_.episodes.push_back(std::move(episode));
}

void FleetExecutive::open_incident(const Cause& cause) {
  executive::Incident incident;
  incident.time_s = time_s_;
  incident.kind = cause.kind;
  incident.evidence = cause.evidence;
  incident.action = cause.vehicle;
  record_.incidents.push_back(std::move(incident));
  working_ = true;
  working_since_ = std::chrono::steady_clock::now();
}

void FleetExecutive::decide(Response response) {
  if (record_.incidents.empty() || record_.incidents.back().response != Response::Open) return;
  executive::Incident& incident = record_.incidents.back();
  incident.response = response;
  if (std::exchange(working_, false)) {
    incident.decision_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - working_since_).count();
  }
}

// Of the incident that is being decided.
void FleetExecutive::add_evidence(std::string sentence) {
  auto& evidence = record_.incidents.back().evidence;
  if (std::ranges::find(evidence, sentence) == evidence.end()) evidence.push_back(std::move(sentence));
}

}  // namespace stepwright::fleet
