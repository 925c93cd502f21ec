// Incidents, and the plans that answer them: made in a thread of their own while this one watches.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "supervisor/executive/executive.h"
#include "supervisor/pddl/plan/describe_run.h"

namespace stepwright::executive {
namespace {

using std::chrono::milliseconds;

// Between two looks at the plant while a plan is made.
constexpr milliseconds kLook{5};

// Who wants something else, or a pause, does so in any state.
bool is_wish(run::IncidentKind kind) {
  return kind == run::IncidentKind::NewGoal || kind == run::IncidentKind::ChangedDemand ||
         kind == run::IncidentKind::Operator;
}

// Of a process that was not there, which says nothing about the plant.
bool is_absence(run::IncidentKind kind) {
  return kind == run::IncidentKind::LostRuntime || kind == run::IncidentKind::LostSupervisor;
}

run::Response response_of(const run::Episode& episode) {
  if (episode.origin == "kept") return run::Response::GoOn;
  return episode.origin == "repaired" ? run::Response::Repair : run::Response::Replan;
}

// "belt r and belt d1"
std::string names_of(const std::vector<std::string>& devices) {
  return fmt::format("{}", fmt::join(devices, " and "));
}

}  // namespace

void Executive::opened(run::Incident& incident) {
  incident.alarms = std::exchange(alarms_, {});
  earlier_.insert(earlier_.end(), differences_.begin(), differences_.end());
  differences_.clear();
}

void Executive::note_failed_devices(const run::Cause& cause) {
  run::Incident& incident = record_.incidents.back();
  incident.devices = devices_.suspect(cause.devices);
  if (incident.devices.empty()) return;
  incident.kind = run::IncidentKind::FailedActuator;
  incident.evidence.push_back("twice, what needs " + names_of(incident.devices) +
                              " has not come to its end: planned without");
}

// There is no plan, which may be for want of a device.
bool Executive::give_up_planless() {
  std::string text =
      record_.replans.empty() ? "there is no plan" : "there is no plan from the observed state";
  const std::set<std::string>& failed = devices_.failed();
  if (!failed.empty()) {
    text += " without " + names_of({failed.begin(), failed.end()}) + " (with which actions failed twice)";
  }
  return give_up(text + ": " + unplannable_.reason, run::IncidentKind::ProgramFault, unplannable_.exit);
}

// News that makes the planning under way worthless.
void Executive::overtake(std::string evidence) {
  if (record_.incidents.empty() || record_.incidents.back().response != run::Response::Open) return;
  record_.incidents.back().evidence.push_back(std::move(evidence));
  ++record_.incidents.back().restarts;
}

std::vector<model::GroundAction> Executive::remaining_actions() const {
  std::vector<model::GroundAction> remaining;
  for (std::size_t i = 0; i < progress_.actions.size(); ++i) {
    if (progress_.actions[i] != run::ActionState::Done && !progress_.rests(i))
      remaining.push_back(current_.plan.actions[i]);
  }
  return remaining;
}

void Executive::close_episode(std::string& last_done) {
  if (record_.episodes.empty()) return;
  std::vector<run::ActionRecord>& actions = record_.episodes.back().actions;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    run::ActionRecord& action = actions[i];
    if (action.state == run::ActionState::Active && progress_.rests(i)) {
      action.state = run::ActionState::Done;
      note_done(i, clock_.now_s());
    }
    if (action.state == run::ActionState::Done) last_done = action.text;
    if (action.state == run::ActionState::Active) action.state = run::ActionState::Failed;
  }
}

bool Executive::replan(const run::Cause& cause) {
  std::string last_done;
  close_episode(last_done);
  const std::string sentence = run::sentence_of(cause.evidence);
  open_incident(cause);
  if (cause.stops()) return give_up(cause);
  const bool held = cause.kind == run::IncidentKind::Operator;
  const std::size_t replans = counted(record_.replans);
  if (!held && static_cast<int>(replans) >= options_.max_replans) {
    return give_up("after " + std::to_string(replans) + " replans: " + sentence, cause.kind);
  }
  record_.replans.push_back({clock_.now_s(), sentence, last_done, held});
  note_failed_devices(cause);
  if (is_wish(cause.kind)) recurrence_.forget();
  if (is_absence(cause.kind)) drift_.forget();
  set_phase(hold_ ? run::Phase::Holding : run::Phase::Replanning, sentence);
  // A program that runs is relieved by the next one, without a stop. Anything else stops at once, not only
  // with the download that follows; a runtime that is gone or was restarted has nothing to stop.
  if (!runs()) (void)controller_.stop(sentence.substr(0, 200));
  const model::NamedState tracked =
      progress_.actions.empty() ? pddl::to_named(planning_.task().initial())
                                : translate::expected_state(current_.translation, progress_.completed());
  return mend(cause.signature, tracked, begun_actions(false), remaining_actions());
}

// From the observed state to a plan that runs.
bool Executive::mend(const std::string& signature, const model::NamedState& tracked,
                     const std::vector<model::GroundAction>& interrupted,
                     const std::vector<model::GroundAction>& remaining) {
  follows_ = false;
  while (true) {
    work_pauses();  // observing the plant does not count
    if (!observe(true)) return false;
    if (hold_) {
      // For whoever wants to know meanwhile; what is wrong with it shows when the run goes on.
      if (auto now =
              translate::estimate(planning_.binding(), means_, tare_, with_changes(tracked), interrupted))
        seen_ = std::move(*now);
      if (!stay_held()) return false;
      continue;  // the plant may be elsewhere by now
    }
    work_begins();
    auto estimate =
        translate::estimate(planning_.binding(), means_, tare_, with_changes(tracked), interrupted);
    if (!estimate) return give_up("the state cannot be read", estimate.error());
    if (!estimate->contradictions.empty()) {
      record_.incidents.back().kind = run::IncidentKind::FailedSensor;
      return give_up("the observed state contradicts itself: " + run::sentence_of(estimate->contradictions));
    }
    seen_ = std::move(*estimate);
    drift_.rest(seen_.measured.fluents);
    if (const auto drift = drift_.found()) {
      record_.incidents.back().kind = cause_of(*drift).kind;
      return give_up(to_string(*drift));
    }
    const model::NamedState planning = with_changes(seen_.planning);
    const run::Incident& incident = record_.incidents.back();
    // A wish and the end of a process come in any state.
    const bool plants_own = !is_wish(incident.kind) && !is_absence(incident.kind);
    if (plants_own && incident.devices.empty() && !interrupted.empty() && planning == stuck_at_) {
      return give_up("the plant does not follow: for the second time in the same state, " +
                     record_.replans.back().cause);
    }
    const Planned planned = plan_to_goal(tracked, interrupted, remaining);
    if (planned == Planned::Over) return false;
    if (planned == Planned::Again) continue;
    if (planned == Planned::None) return give_up_planless();
    if (hold_) continue;
    stuck_at_ = with_changes(seen_.planning);
    const bool left = !current_.plan.actions.empty();
    if (left && !signature.empty() && recurrence_.in_vain(signature, current_.plan.actions.size())) {
      return give_up("the same has happened for the third time, and the goal has come no nearer: " +
                     record_.replans.back().cause);
    }
    record_.incidents.back().repair_ms = current_.episode.repair_ms;
    record_.incidents.back().replan_ms = current_.episode.replan_ms;
    record_.incidents.back().kept = current_.episode.kept;
    record_.incidents.back().remaining = current_.episode.remaining;
    decide(response_of(current_.episode));
    if (!current_.plan.actions.empty()) return launch();
    reach_goal();
    return false;
  }
}

// A plan that reaches the goal for a planner, who counts in whole units, and for the sensors: if a fraction
// of a unit would be left over that is no goal any more, it is planned for as a whole one. Its action ends
// at the level that the goal wants, and moves as little as that takes.
Executive::Planned Executive::plan_to_goal(const model::NamedState& tracked,
                                           const std::vector<model::GroundAction>& interrupted,
                                           const std::vector<model::GroundAction>& remaining) {
  StartState start{.planning = with_changes(seen_.planning),
                   .measured = seen_.measured.fluents,
                   .tare = tare_,
                   .goal = goal_};
  const Planned planned = plan_watched(start, remaining);
  if (planned != Planned::Ready) return planned;
  note_goal();
  const std::vector<translate::Difference> left = left_over();
  if (left.empty()) return Planned::Ready;
  std::set<std::string> away;
  std::vector<std::string> sentences;
  for (const translate::Difference& difference : left) {
    away.insert(difference.atom);
    sentences.push_back(to_string(difference));
  }
  auto finer =
      translate::estimate(planning_.binding(), means_, tare_, with_changes(tracked), interrupted, away);
  if (finer) {
    start.planning = with_changes(finer->planning);
    start.goal = goal_;
    const Planned again = plan_watched(start, remaining);
    if (again == Planned::Again || again == Planned::Over) return again;
    if (again == Planned::Ready && left_over().empty()) return Planned::Ready;
  }
  unplannable_ = {"what would be left over is less than a plan can mend: " + run::sentence_of(sentences)};
  return Planned::None;
}

// Levels of the goal at the end of the plan, as the sensors would show them.
std::vector<translate::Difference> Executive::left_over() const {
  const std::vector<model::PlannedAction>& actions = current_.run.actions;
  const model::NamedState& wanted = actions.empty() ? current_.run.initial : actions.back().after;
  const model::NamedState shown =
      translate::expected_state(current_.translation, std::vector<bool>(actions.size(), true));
  std::set<std::string> ignored = beside_goal();
  for (const translate::ObservedFact& fact : planning_.binding().facts) ignored.insert(fact.fact);
  return translate::differences(planning_.binding(), wanted, shown, ignored);
}

Executive::Planned Executive::plan_watched(StartState start,
                                           const std::vector<model::GroundAction>& remaining) {
  while (true) {
    PlanningJob job(planning_, {.start = start, .remaining = remaining, .without = devices_.failed()});
    RestWatch rest(planning_.binding(), tare_, seen_.measured);
    bool again = false;
    while (!again && !job.wait(kLook)) {
      if (const auto end = overtaken(job, start, rest, again)) return *end;
    }
    if (again) continue;
    auto outcome = job.take();
    if (!outcome && waits_) {
      unplannable_ = {"no program could be made: " + result::to_string(outcome.error())};
      return Planned::None;
    }
    if (!outcome) {
      give_up("no program could be made", outcome.error());
      return Planned::Over;
    }
    if (outcome->status != PrepareStatus::Ready) {
      const bool first = record_.replans.empty();
      unplannable_ = {outcome->reason, !first ? result::ExitCode::RuntimeFault
                                       : outcome->status == PrepareStatus::Infeasible
                                           ? result::ExitCode::NoPlan
                                           : result::ExitCode::BudgetExhausted};
      return Planned::None;
    }
    current_ = std::move(outcome->prepared);
    return Planned::Ready;
  }
}

// One look while a plan is made. `again`: the same plant, but something else is wanted of it.
std::optional<Executive::Planned> Executive::overtaken(PlanningJob& job, StartState& start, RestWatch& rest,
                                                       bool& again) {
  if (abort_) {
    job.cancel();
    give_up_aborted();
    return Planned::Over;
  }
  if (const auto change = due(clock_.now_s())) {
    job.cancel();
    overtake(run::sentence_of(change->evidence));
    start.planning = with_changes(start.planning);
    start.goal = goal_;
    again = true;
    return std::nullopt;
  }
  if (!reader_) {  // before the first program there is nothing to watch
    if (hold_ != journalled_hold_) publish(/*now=*/true);
    return std::nullopt;
  }
  if (hold_) {
    job.cancel();
    overtake("held by the operator");
    set_phase(run::Phase::Holding, "held by the operator");
    return Planned::Again;
  }
  if (!controller_.alive()) {
    job.cancel();
    overtake("the runtime does not answer");
    return Planned::Again;
  }
  // With a barrier the clock stands still from the observation on, and the plant with it.
  if (options_.barrier) return std::nullopt;
  if (const auto event = controller_.wait_event(milliseconds(0))) {
    (void)controller_.acknowledge(event->sequence);
    if (event->program_digest == digest_ && run::ends_program(event->kind)) {
      job.cancel();
      overtake("the runtime stopped while a plan was made: " + event->detail);
      return Planned::Again;
    }
  }
  const auto snapshot = controller_.snapshot();
  if (!snapshot || snapshot->program_digest != digest_) return std::nullopt;
  const auto news = rest.see(reader_->values(snapshot->image), snapshot->scan);
  if (!news) return std::nullopt;
  job.cancel();
  overtake(*news);
  return Planned::Again;
}

}  // namespace stepwright::executive
