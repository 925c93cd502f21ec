// From start to end.

#include "supervisor/fleet/executive/fleet_executive.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/service/answer_codes.h"
#include "supervisor/fleet/executive/fleet_journal.h"

namespace stepwright::fleet {

using run::IncidentKind;
using run::Phase;
using run::Response;
using std::chrono::milliseconds;

FleetExecutive::FleetExecutive(FleetPlanning& planning, run::Controller& controller,
                               FleetExecutiveOptions options, Observer observer)
    : MovingMission(controller, {options.cell, options.barrier, options.operator_starts},
                    {options.max_replans, options.attended, options.hold},
                    {.what = "the fleet",
                     .rests = "all vehicles rest",
                     .until = "the run is resumed",
                     .another = "other orders",
                     .stopped = "the fleet was stopped while it was held"},
                    std::move(observer)),
      planning_(planning),
      options_(std::move(options)),
      ledger_(planning.problem()),
      tracks_(planning.problem().vehicles.size()),
      standing_(planning.problem().vehicles.size()),
      returning_(planning.problem().vehicles.size()),
      begun_(planning.problem().vehicles.size()),
      resets_(planning.problem().vehicles.size(), false),
      requests_(options_.requests) {}

bool FleetExecutive::begin() {
  set_phase(Phase::Planning, "planning the missions of the fleet");
  return resume() || (record_.phase == Phase::Planning && start_afresh());
}

// False with phase Planning: there is nothing to go on with.
bool FleetExecutive::resume() {
  if (options_.journal.empty()) return false;
  auto journal = read_fleet_journal(options_.journal);
  if (!journal) return give_up(result::to_string(journal.error()), IncidentKind::ProgramFault);
  if (!*journal) return false;
  FleetJournal& known = **journal;
  if (known.record.phase == Phase::Done || known.record.phase == Phase::Safe) return false;
  if (!ledger_.restore(known.ledger)) {
    return give_up("the journal is of another problem", IncidentKind::ProgramFault);
  }
  if (known.record.phase == Phase::Ready || known.record.episodes.empty()) {  // nothing had begun
    blocked_ = std::move(known.blocked);
    requests_.go_on_at(known.next_request);
    return false;
  }
  known.request.cancel = &abort_;
  auto outcome = planning_.plan(ledger_, known.request);
  if (!outcome || !outcome->prepared.program) {
    return give_up("the plan that runs cannot be made again", IncidentKind::ProgramFault);
  }
  record_ = std::move(known.record);
  blocked_ = std::move(known.blocked);
  requests_.go_on_at(known.next_request);
  first_epoch_s_ = known.first_epoch_s;
  epoch_s_ = known.epoch_s;
  clock_ = run::RunClock(known.clock);
  revision_ = known.request.revision;
  for (const Standing& each : known.request.standing) {
    if (ledger_.vehicles()[each.vehicle].lost) standing_[each.vehicle] = each;
  }
  set_phase(Phase::Waiting, "the supervisor was restarted and looks for its runtime");
  return await_runtime() && resume_plan(*std::move(outcome), known.request);
}

// The runtime has to have that very program, and to run it.
bool FleetExecutive::resume_plan(FleetOutcome outcome, const FleetRequest& request) {
  auto reader = FleetReader::create(outcome.prepared.container, *outcome.prepared.program);
  const auto status = controller_.status();
  if (status) digest_ = status->program_digest;  // the container tells whether it is that one
  if (!reader || !runs_program(outcome.prepared.container)) {
    (void)controller_.stop("the supervisor was restarted and does not know this program");
    return give_up("the supervisor was restarted, and the runtime does not run the plan of its journal",
                   IncidentKind::LostRuntime);
  }
  reader_ = *std::move(reader);
  follow_plan(std::move(outcome), request);
  open_incident(
      {IncidentKind::LostSupervisor, {"the supervisor was restarted; the missions have gone on"}, {}});
  decide(Response::GoOn);
  set_phase(Phase::Executing, "following the missions again");
  return true;  // what happened meanwhile shows in the next event
}

void FleetExecutive::write_journal() {
  if (options_.journal.empty() || !follow_) return;
  // A journal that cannot be written costs a restart its memory, not this run.
  (void)write_fleet_journal(options_.journal, {{record_, clock_.state(), requests_.next()},
                                               reader_ ? planned_from_ : ledger_.state(),
                                               planned_as_,
                                               blocked_,
                                               first_epoch_s_,
                                               epoch_s_});
}

// The missions run without anybody who follows them. A runtime that has them still goes on; one that has lost
// them has stopped the vehicles.
bool FleetExecutive::recover_runtime() {
  if (has_gone_on()) {
    set_phase(Phase::Executing, "following the missions again");
    return true;
  }
  if (record_.phase == Phase::Safe) return false;
  if (const auto loaded = carrier()) {
    return give_up(
        "the runtime was restarted, and the forks of " + *loaded + " have left their load somewhere",
        IncidentKind::LostRuntime);
  }
  return replan(
      {IncidentKind::LostRuntime, {"the runtime was restarted or stopped while nobody watched it"}, {}});
}

// What of the loads is not where it was to be, as sentences.
std::vector<std::string> FleetExecutive::missed() const {
  std::vector<std::string> sentences;
  const MissionProblem& problem = ledger_.problem();
  for (std::size_t k = 0; k < problem.goals.size(); ++k) {
    const GoalEntry& goal = ledger_.goals()[k];
    if (goal.delivered >= goal.amount) continue;
    std::string text = fmt::format("{} of {} of '{}' are not delivered", goal.amount - goal.delivered,
                                   goal.amount, problem.goals[k].name);
    for (std::uint32_t v = 0; v < ledger_.vehicles().size(); ++v) {
      const auto aboard = ledger_.vehicles()[v].aboard.find(k);
      if (aboard == ledger_.vehicles()[v].aboard.end()) continue;
      text += fmt::format(" ({} aboard of {}{})", aboard->second, problem.vehicles[v].name,
                          shut_in(v) ? ", which cannot leave where it stands" : "");
    }
    if (!goal.why.empty()) text += ": " + goal.why;
    sentences.push_back(std::move(text));
  }
  return sentences;
}

// It took no part in the plan although it is not lost.
bool FleetExecutive::shut_in(std::uint32_t v) const {
  const auto& starts = planned_as_.rest.starts;
  return v < starts.size() && !starts[v].able && !ledger_.vehicles()[v].lost;
}

// Somebody was shut in, and others have driven away since.
bool FleetExecutive::has_more_room() const {
  bool any = false, moved = false;
  for (std::uint32_t v = 0; v < ledger_.vehicles().size(); ++v) {
    any = any || shut_in(v);
    moved = moved || (!shut_in(v) && follow_->plan().missions[v].path.size() > 1);
  }
  return any && moved;
}

bool FleetExecutive::finish() {
  const std::vector<std::string> left = missed();
  if (!left.empty() && has_more_room()) {
    ledger_.reopen();
    return replan({IncidentKind::Position, {"others have driven away from who could not leave"}, {}});
  }
  if (!left.empty()) {
    const std::string text = fmt::format("all that could be done is done: {}", fmt::join(left, "; "));
    open_incident({IncidentKind::Position, {text}, {}});
    if (nobody_comes()) return give_up(text, IncidentKind::Position);
    if (!bring_to_rest() || !stay(text, IncidentKind::Position) || !bring_to_rest()) return false;
    ledger_.reopen();
    return plan_from_rest();
  }
  (void)controller_.stop("all missions are done");  // a lost runtime has stopped already
  set_phase(Phase::Done, "everything is delivered, and every vehicle rests");
  return false;
}

void FleetExecutive::note_goals() {
  record_.goal.clear();
  const MissionProblem& problem = ledger_.problem();
  for (std::size_t k = 0; k < problem.goals.size(); ++k) {
    const GoalEntry& entry = ledger_.goals()[k];
    record_.goal.push_back({fmt::format("{} {} from {} to {}", entry.amount, problem.goals[k].name,
                                        problem.locations[problem.goals[k].from].name,
                                        problem.locations[problem.goals[k].to].name),
                            entry.delivered >= entry.amount});
  }
}

void FleetExecutive::publish(bool now) {
  changed_ = changed_ || now;
  const auto clock = std::chrono::steady_clock::now();
  if (!changed_ || (!now && clock - published_ < options_.between_documents)) return;
  published_ = clock;
  changed_ = false;
  note_goals();
  renew_document();
  write_journal();
  tell();
}

void FleetExecutive::renew_document() {
  if (planless()) record_.details.erase(kFleetDetails);  // the plan before holds no more
  if (!follow_ || !plan_ || planless()) return;
  std::vector<bool> stuck;
  for (std::uint32_t v = 0; v < ledger_.vehicles().size(); ++v) stuck.push_back(shut_in(v));
  record_.details[kFleetDetails] = fleet_document({.plan = &plan_document_,
                                                   .follow = &*follow_,
                                                   .ledger = &ledger_,
                                                   .blocked = &blocked_,
                                                   .shut_in = std::move(stuck),
                                                   .epoch_s = epoch_s_,
                                                   .first_epoch_s = first_epoch_s_,
                                                   .revision = revision_});
}

}  // namespace stepwright::fleet
