#include "supervisor/executive/executive.h"

#include <algorithm>
#include <utility>

#include "runtime/ground/result/counted.h"
#include "supervisor/executive/journal.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/translate/sensor_program.h"

namespace stepwright::executive {
Executive::Executive(const PlanningService& planning, run::Controller& controller, ExecutiveOptions options,
                     Observer observer)
    : Mission(controller, {options.cell, options.barrier, options.operator_starts}, std::move(observer)),
      planning_(planning),
      options_(std::move(options)),
      drift_(planning.binding()),
      requests_(options_.goal_changes),
      outlook_writer_(planning),
      what_if_(planning, options_.what_if) {}

bool Executive::begin() {
  if (std::exchange(begun_, true)) return begin_again();
  set_phase(run::Phase::Planning, "looking for a plan");
  return resume() || (record_.phase == run::Phase::Planning && start_afresh(/*wanted=*/false));
}

// `wanted`: an operator has started it already.
bool Executive::start_afresh(bool wanted) {
  const Planned first = plan_first();
  if (first == Planned::None) return give_up_planless();
  if (first != Planned::Ready) return false;
  if (options_.operator_starts && !wanted && !stay_ready()) return false;
  const model::NamedState initial = first_state();
  if (!await_runtime() || !observe(false)) return false;
  auto moving = translate::movements(planning_.binding(), means_);
  if (!moving) return give_up("the sensors cannot be read", moving.error());
  if (!moving->empty())
    return give_up("the plant was not at rest when the sensors were tared: " + run::sentence_of(*moving),
                   run::IncidentKind::Level);
  auto tare = translate::identify_tare(planning_.binding(), means_, initial);
  if (!tare)
    return give_up("the sensors do not fit the initial state", tare.error(), run::IncidentKind::FailedSensor);
  tare_ = std::move(*tare);
  known_ = true;
  record_.tare = tare_;  // viewers calibrate with it, too
  auto estimate = translate::estimate(planning_.binding(), means_, tare_, initial);
  if (!estimate) return give_up("the initial state cannot be read", estimate.error());
  seen_ = std::move(*estimate);
  drift_.rest(seen_.measured.fluents);
  const auto wrong = translate::deviations(planning_.binding(), initial, seen_.measured);
  if (!wrong.empty() && options_.believes_sensors) {
    open_incident({run::IncidentKind::Operator,
                   {"the plan starts where the plant is: " + run::sentence_of(wrong)},
                   {}});
    return mend({}, initial, {}, {});
  }
  if (!wrong.empty()) {
    const bool levels = !translate::differences(planning_.binding(), initial, seen_.measured).front().is_fact;
    return replan({levels ? run::IncidentKind::Level : run::IncidentKind::Position,
                   {"the plant is not in the initial state: " + run::sentence_of(wrong)},
                   {}});
  }
  auto rebuilt = planning_.rebuild(
      {.planning = initial, .measured = seen_.measured.fluents, .tare = tare_, .goal = goal_}, current_.plan);
  if (!rebuilt) return give_up("no program could be made", rebuilt.error());
  run::Episode figures = current_.episode;
  current_ = std::move(*rebuilt);
  current_.episode = std::move(figures);
  return hold_ ? replan(held_by_operator()) : launch();
}

bool Executive::resume() {
  if (options_.journal.empty()) return false;
  auto journal = read_journal(options_.journal);
  if (!journal) return give_up("the journal cannot be read", journal.error());
  if (!*journal) return false;
  const run::Phase phase = (*journal)->record.phase;
  if (phase == run::Phase::Done || phase == run::Phase::Safe) return stay_over(*std::move(*journal));
  if ((*journal)->held || phase == run::Phase::Holding || phase == run::Phase::Held) hold_ = true;
  if (phase == run::Phase::Ready || (*journal)->record.episodes.empty()) {
    // Nothing had begun.
    changed_ = std::move((*journal)->changed);
    goal_ = std::move((*journal)->start.goal);
    return false;
  }
  record_ = std::move((*journal)->record);
  changed_ = std::move((*journal)->changed);
  requests_.go_on_at((*journal)->next_request);
  clock_ = run::RunClock((*journal)->clock);
  for (const run::Incident& incident : record_.incidents) devices_.restore(incident.devices);
  tare_ = (*journal)->start.tare;
  known_ = true;
  goal_ = (*journal)->start.goal;
  auto rebuilt = planning_.rebuild((*journal)->start, (*journal)->plan);
  if (!rebuilt) return give_up("the running plan cannot be rebuilt", rebuilt.error());
  current_ = std::move(*rebuilt);
  current_.episode = record_.episodes.back();
  progress_ = {};
  for (const run::ActionRecord& action : record_.episodes.back().actions) {
    progress_.actions.push_back(action.state);
  }
  follows_ = true;
  digest_ = record_.episodes.back().digest;
  drift_.follow(current_.run);  // its sums begin anew
  note_told_alarms();
  set_phase(run::Phase::Waiting, "the supervisor was restarted and looks for its runtime");
  return await_runtime() && recover_runtime(Away::Supervisor);
}

// A run had ended before the supervisor did. Where an operator starts runs it stays so, and another one
// begins from where the plant is; else it begins anew by itself.
bool Executive::stay_over(Journal&& journal) {
  if (!options_.operator_starts) return false;
  record_ = std::move(journal.record);
  changed_ = std::move(journal.changed);
  requests_.go_on_at(journal.next_request);
  clock_ = run::RunClock(journal.clock);
  goal_ = std::move(journal.start.goal);
  tare_ = record_.tare;
  known_ = journal.known;
  seen_.planning = std::move(journal.seen);
  publish(/*now=*/true);
  return false;
}

// The runtime is there (again): goes on with the plan if the runtime still has it, else replans.
bool Executive::recover_runtime(Away who) {
  if (!await_answer()) return false;
  const bool runs = runs_program(current_.container);
  // While it is held nobody expects the plan to run: the plant rests under the program that reads the
  // sensors.
  const bool was_away = who == Away::Supervisor;
  if (!runs && was_away && hold_) {
    return replan(
        {run::IncidentKind::Operator, {"held by the operator; the supervisor was restarted meanwhile"}, {}});
  }
  if (!runs) {
    // A runtime that still has the program was not lost: it has stopped because nobody was there.
    const auto status = controller_.status();
    const bool has_program = was_away && status && status->program_digest == digest_;
    if (has_program)
      return replan(
          {run::IncidentKind::LostSupervisor, {"the runtime has stopped while the supervisor was away"}, {}});
    return replan({run::IncidentKind::LostRuntime,
                   {"the runtime was restarted or stopped while nobody watched it"},
                   {}});
  }
  if (was_away) {
    open_incident({run::IncidentKind::LostSupervisor,
                   {"the supervisor was restarted; the runtime has gone on with the plan"},
                   {}});
  } else {
    open_incident({run::IncidentKind::LostRuntime,
                   {"the runtime was not seen for a while; it has gone on with the plan"},
                   {}});
  }
  if (!read_program(current_, Kind::Plan)) return false;
  decide(run::Response::GoOn);
  confirmed_ = true;
  set_phase(run::Phase::Executing, "following the plan again");
  // What happened meanwhile shows in the present steps; an event that the runtime waits for comes by itself.
  const auto snapshot = controller_.snapshot();
  if (!snapshot || snapshot->program_digest != digest_) return true;
  clock_.see(snapshot->incarnation, snapshot->time_ns);
  unwatched_ = true;
  const run::Decision decision = judge_steps(snapshot->image, clock_.now_s());
  unwatched_ = false;
  if (decision.verdict == run::Verdict::Finished) return finish();
  if (decision.verdict == run::Verdict::Replan) return replan(decision.cause);
  return decision.verdict == run::Verdict::GiveUp ? give_up(decision.cause) : true;
}

bool Executive::observe(bool locate) {
  auto observer = planning_.observer(locate, options_.settle);
  if (!observer) return give_up("no program could be made", observer.error());
  if (record_.phase == run::Phase::Planning) set_phase(run::Phase::Observing, "reading the sensors");
  while (!abort_) {
    if (!await_runtime()) return false;
    if (!install(*observer, Kind::Observer)) {
      if (record_.phase == run::Phase::Safe) return false;
      continue;
    }
    const Rest rest = observe_once(*observer);
    if (rest != Rest::Lost) return rest == Rest::Reached && !give_up_leap();
  }
  return give_up_aborted();
}

// The clock stands still at the event with which all is known, while the plan is made.
Executive::Rest Executive::observe_once(const PreparedPlan& observer) {
  std::string failed;
  const Rest rest = await_rest({.stopped = "the runtime stopped while the sensors were read",
                                .rolled_back = "the program that reads the sensors trapped",
                                .goes_on = false,  // what it has missed has to be read anew
                                .see = [&](std::span<const std::byte> image) -> std::optional<Rest> {
                                  const auto progress =
                                      translate::progress(observer.translation, reader_->active_steps(image));
                                  if (!progress.failed_steps.empty())
                                    failed = observer.translation.steps[progress.failed_steps.front()].name;
                                  if (failed.empty() && !progress.finished) return std::nullopt;
                                  if (failed.empty()) means_ = reader_->values(image);
                                  return Rest::Reached;
                                }});
  if (failed.empty()) return rest;
  give_up("the plant cannot be brought to a known place (" + failed + ")");
  return Rest::Ended;
}

// True, and the run is over, if a sensor has leapt while the plant was observed, or since the plan before:
// what it shows now would be believed.
bool Executive::give_up_leap() {
  for (const translate::Sensor& sensor : planning_.binding().sensors) {
    const auto leaping = means_.find(translate::leaping_variable(sensor));
    if (leaping == means_.end() || leaping->second < translate::kLeapingScans) continue;
    const bool open = !record_.incidents.empty() && record_.incidents.back().response == run::Response::Open;
    if (open) record_.incidents.back().kind = run::IncidentKind::FailedSensor;
    return !give_up("sensor " + sensor.name + " leaps: no plant changes so fast",
                    run::IncidentKind::FailedSensor);
  }
  return false;
}

bool Executive::launch() {
  record_.episodes.push_back(current_.episode);
  left_ = current_.start.measured;
  drift_.follow(current_.run);
  progress_ = {};
  progress_.actions.assign(current_.plan.actions.size(), run::ActionState::Pending);
  follows_ = true;
  if (record_.episodes.size() == 1) record_.started_s = clock_.now_s();
  record_.episodes.back().started_s = clock_.now_s();
  if (!bring_to_run([this] { return install(current_, Kind::Plan); })) return false;
  record_.episodes.back().digest = digest_;
  set_phase(run::Phase::Executing,
            "executing a plan of " + result::counted(current_.plan.actions.size(), "action", "actions"));
  return true;
}

// A planner counts in units: a level that it takes for 9 is no 9 where the sensor shows 9.24.
void Executive::note_goal() {
  model::NamedState shown = with_changes(seen_.planning);
  for (const translate::Difference& off :
       translate::differences(planning_.binding(), shown, seen_.measured)) {
    if (!off.is_fact) shown.fluents[off.atom] = off.measured;
  }
  record_.goal = planning_.goal_status(shown, goal_);
}

// Measured fluents that the goal does not speak of.
std::set<std::string> Executive::beside_goal() const {
  std::set<std::string> fluents;
  for (const translate::Sensor& sensor : planning_.binding().sensors) {
    const bool named = std::any_of(
        record_.goal.begin(), record_.goal.end(),
        [&](const run::GoalRecord& goal) { return goal.text.find(sensor.fluent) != std::string::npos; });
    if (!named) fluents.insert(sensor.fluent);
  }
  return fluents;
}

// What of the goal is not there, as sentences.
std::vector<std::string> Executive::missed() const {
  std::vector<std::string> sentences =
      translate::deviations(planning_.binding(), with_changes(seen_.planning), seen_.measured, beside_goal());
  for (const run::GoalRecord& goal : record_.goal) {
    if (!goal.met) sentences.push_back(goal.text + " is not met");
  }
  return sentences;
}

// The plan has ended. Amounts that no sensor sees and fractions of what a planner counts in add up over a
// run, so the goal may need another plan.
bool Executive::finish() {
  note_goal();
  const std::vector<std::string> left = missed();
  if (left.empty()) {
    reach_goal();
    return false;
  }
  return replan({run::IncidentKind::Level,
                 {"the plan has ended, but the goal is not reached: " + run::sentence_of(left)},
                 {},
                 {},
                 "the goal is not reached"});
}

void Executive::reach_goal() {
  (void)controller_.stop("the plan is done");  // a lost runtime has stopped already
  set_phase(run::Phase::Done, "the goal is reached");
}

void Executive::publish(bool now) {
  if (!now) return;  // every change is told at once
  // Of a run of which nothing has begun only a hold is worth keeping.
  if (!options_.journal.empty() && (!record_.episodes.empty() || hold_ || journalled_hold_)) {
    journalled_hold_ = hold_;
    Journal journal{{record_, clock_.state(), requests_.next()},
                    current_.start,
                    current_.plan,
                    changed_,
                    journalled_hold_,
                    known_,
                    seen_.planning};
    journal.start.goal = goal_;
    // A journal that cannot be written costs a restart its memory, not this run.
    (void)write_journal(options_.journal, journal);
  }
  renew_outlook();
  tell();
}

}  // namespace stepwright::executive
