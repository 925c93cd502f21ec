// From one run to the next: waiting for an operator before a plan begins, and beginning again where the plant
// is after a run that has ended.

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "runtime/service/answer_codes.h"
#include "supervisor/executive/executive.h"
#include "supervisor/executive/journal.h"
#include "supervisor/pddl/plan/describe_run.h"

namespace stepwright::executive {
namespace {

// As a planner counts it: a level is expected where a pump stops, not at a multiple.
double counted(const translate::Binding& binding, const std::string& fluent, double value) {
  const translate::Sensor* sensor = binding.sensor_of(fluent);
  if (sensor == nullptr || sensor->resolution <= 0.0) return value;
  return std::round(value / sensor->resolution) * sensor->resolution;
}

}  // namespace

// The problem's, with what has been changed from outside.
model::NamedState Executive::first_state() const {
  return with_changes(pddl::to_named(planning_.task().initial()));
}

Executive::Planned Executive::plan_first() {
  const Planned planned = plan_watched({.planning = first_state(), .goal = goal_}, {});
  if (planned == Planned::Ready) record_.goal = planning_.goal_status(first_state(), goal_);
  return planned;
}

// Whoever wanted it started wanted that, and not the plan before.
void Executive::refuse_change(run::Cause cause, Asked before) {
  goal_ = std::move(before.goal);
  changed_ = std::move(before.changed);
  cause.evidence.push_back("that is refused, there is no plan for it: " + unplannable_.reason);
  open_incident(cause);
  decide(run::Response::GoOn);
  forget_start();
}

// The plan is shown, and the runtime is not touched until an operator wants it. False if the run is over.
bool Executive::stay_ready() {
  waits_ = true;
  const bool started = await_people();
  waits_ = false;
  if (!started) return false;
  begin_start();
  record_.episodes.clear();
  set_phase(run::Phase::Planning, "started by the operator");
  return true;
}

// What is wanted meanwhile and cannot be planned is refused.
bool Executive::await_people() {
  while (true) {
    record_.episodes = {current_.episode};
    Asked before{goal_, changed_};
    std::optional<run::Cause> change;
    const Wish wish =
        await_wish(Stage::Ready,
                   fmt::format("a plan of {} actions is ready: nothing moves until an operator starts it",
                               current_.plan.actions.size()),
                   change);
    if (wish != Wish::OtherPlan) return wish == Wish::Start;
    bool started = start_wanted();
    record_.episodes.clear();
    set_phase(run::Phase::Planning, "looking for a plan for what is wanted now");
    const Planned planned = plan_first();
    if (planned == Planned::None) {
      refuse_change(*std::move(change), std::move(before));
      started = false;
    } else if (planned != Planned::Ready) {
      return false;
    }
    if (started) return true;
  }
}

// Another run from where the plant is, however the one before has ended: as after a hold, with nothing kept
// of the plan before. What no sensor sees stands as the run before has left it.
bool Executive::begin_again() {
  begin_start();
  another_run_ = true;
  const std::vector<model::GroundAction> interrupted =
      follows_ ? begun_actions(false) : std::vector<model::GroundAction>();
  model::NamedState tracked = first_state();
  if (follows_) {
    tracked = translate::expected_state(current_.translation, progress_.completed());
  } else if (!seen_.planning.facts.empty() || !seen_.planning.fluents.empty()) {
    tracked = seen_.planning;
  }
  forget_run();
  (void)due(clock_.now_s());  // the goal that the run was started with
  set_phase(run::Phase::Planning, "started by the operator");
  if (!known_) return start_afresh(/*wanted=*/true);
  open_incident({run::IncidentKind::Operator, {"started by the operator"}, {}});
  return mend({}, tracked, interrupted, {});
}

// Cell, clock, tare and drift of the sensors belong to the plant; everything else to the run.
void Executive::forget_run() {
  run::RunRecord fresh;
  fresh.cell = std::move(record_.cell);
  fresh.expected = std::move(record_.expected);
  fresh.observed = std::move(record_.observed);
  fresh.tare = std::move(record_.tare);
  fresh.started_s = clock_.now_s();
  fresh.finished_s = clock_.now_s();
  record_ = std::move(fresh);
  devices_ = {};
  recurrence_.forget();
  drift_.forget();
  earlier_.clear();
  differences_.clear();
  alarms_.clear();
  alarms_told_.clear();
  left_.clear();
  just_changed_.clear();
  limited_.clear();
  stuck_at_ = {};
  unplannable_ = {};
  reader_.reset();
  alarm_reader_.reset();
  unwatched_ = false;
}

Outlook Executive::outlook() const {
  const std::lock_guard lock(outlook_mutex_);
  return outlook_;
}

std::uint64_t Executive::outlook_revision() const {
  const std::lock_guard lock(outlook_mutex_);
  return outlook_.revision;
}

// Where a plan would begin: while one is followed, where the actions that run now will have led.
void Executive::renew_outlook() {
  Outlook now;
  now.goal = goal_;
  now.without = devices_.failed();
  const bool seen = !seen_.planning.facts.empty() || !seen_.planning.fluents.empty();
  now.state = with_changes(seen ? seen_.planning : pddl::to_named(planning_.task().initial()));
  if (record_.phase == run::Phase::Ready) now.remaining = current_.plan.actions;
  const std::size_t actions = progress_.actions.size();
  if (follows_ && actions == current_.run.actions.size()) {
    std::vector<bool> ended = progress_.completed();
    for (std::size_t i = 0; i < actions; ++i) {
      const bool runs = progress_.actions[i] == run::ActionState::Active;
      now.ahead = now.ahead || (runs && !ended[i]);
      ended[i] = ended[i] || runs;
      if (progress_.actions[i] == run::ActionState::Pending)
        now.remaining.push_back(current_.plan.actions[i]);
    }
    const model::NamedState after = with_changes(translate::expected_state(current_.translation, ended));
    if (!seen) now.state = after;
    for (const std::string& atom : moving_atoms(progress_)) {
      now.state.facts.erase(atom);
      if (after.facts.contains(atom)) now.state.facts.insert(atom);
      if (const auto value = after.fluents.find(atom); value != after.fluents.end())
        now.state.fluents[atom] = counted(planning_.binding(), atom, value->second);
    }
    if (record_.phase == run::Phase::Done || record_.phase == run::Phase::Safe) now.remaining.clear();
  }
  const std::lock_guard lock(outlook_mutex_);
  now.revision = outlook_.revision + 1;
  outlook_ = std::move(now);
}

}  // namespace stepwright::executive
