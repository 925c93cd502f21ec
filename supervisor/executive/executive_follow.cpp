// Watching one program: events, progress, deviations.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "supervisor/executive/executive.h"
#include "supervisor/pddl/definition/state.h"
#include "supervisor/translate/monitors.h"

namespace stepwright::executive {
namespace {

// Where the converter of a broken wire stands.
bool at_end_of_range(const std::string& type, double counts) {
  return type == "UINT" ? counts >= 65'535.0 : counts >= 32'767.0 || counts <= -32'768.0;
}

std::vector<std::string> limited_sensors(const translate::Binding& binding, const translate::Values& values) {
  std::vector<std::string> limited;
  for (const translate::Sensor& sensor : binding.sensors) {
    if (at_end_of_range(binding.tag(sensor.tag)->type, values.at(sensor.tag))) limited.push_back(sensor.name);
  }
  return limited;
}

void record_levels(const translate::Binding& binding, const model::NamedState& expected,
                   const model::NamedState& measured, run::RunRecord& record) {
  for (const translate::Sensor& sensor : binding.sensors) {
    if (auto value = expected.fluents.find(sensor.fluent); value != expected.fluents.end()) {
      record.expected[sensor.fluent] = value->second;
    }
    record.observed[sensor.fluent] = measured.fluents.at(sensor.fluent);
  }
}

}  // namespace

run::Decision Executive::judge_image(std::span<const std::byte> image) {
  return judge_steps(image, clock_.now_s());
}

run::Decision Executive::judge_steps(std::span<const std::byte> image, double time_s) {
  const std::vector<bool> active = reader_->active_steps(image);
  const translate::Progress progress = translate::progress(current_.translation, active);
  progress_ = progress;
  const model::NamedState expected =
      with_changes(translate::expected_state(current_.translation, progress.done()));
  const auto values = reader_->values(image);
  limited_ = limited_sensors(planning_.binding(), values);
  auto estimate = translate::estimate(planning_.binding(), values, tare_, expected, begun_actions(true));
  if (!estimate)
    return run::give_up_because(run::IncidentKind::ProgramFault, result::to_string(estimate.error()));
  seen_ = std::move(*estimate);
  note_progress(progress, time_s);
  record_levels(planning_.binding(), expected, seen_.measured, record_);
  note_goal();
  note_alarms(image);
  note_levels(moving_atoms(progress));
  if (settled(active)) drift_.see(seen_.measured.fluents, progress);
  publish(/*now=*/true);
  const Situation now = situation(progress, expected, time_s);
  const bool news = settled(active) || !now.failed.empty() || !now.leapt.empty();
  if (const auto cause = news ? classify(now) : std::nullopt) {
    for (const translate::Difference& difference : now.differences) {
      if (by_itself(now, difference)) differences_.push_back(difference);
    }
    return {run::Verdict::Replan, *cause};
  }
  if (auto change = due(time_s)) return {run::Verdict::Replan, *change};
  if (!alarms_.empty()) {  // what was lost is there again, or lies within the tolerance of the plan
    std::vector<std::string> sentences;
    for (const run::Alarm& alarm : alarms_) sentences.push_back(to_string(alarm));
    open_incident({alarms_.front().sensor.empty() ? run::IncidentKind::Position : run::IncidentKind::Level,
                   std::move(sentences), alarms_.front().action});
    decide(run::Response::GoOn);
  }
  return progress.finished ? run::Decision{run::Verdict::Finished} : run::Decision{};
}

void Executive::note_levels(const std::set<std::string>& moving) {
  for (const translate::Sensor& sensor : planning_.binding().sensors) {
    const bool touched = moving.contains(sensor.fluent) || just_changed_.contains(sensor.fluent);
    const double level = seen_.measured.fluents.at(sensor.fluent);
    if (touched) left_[sensor.fluent] = level;
  }
}

// What running and failed actions change. What a vehicle passes on its way counts, too.
std::set<std::string> Executive::moving_atoms(const translate::Progress& progress) const {
  std::set<std::string> moving;
  for (std::size_t i = 0; i < progress.actions.size(); ++i) {
    if (progress.actions[i] != run::ActionState::Active && progress.actions[i] != run::ActionState::Failed)
      continue;
    moving.merge(translate::changed_atoms(current_.run.actions[i]));
  }
  for (const translate::OneOf& group : planning_.binding().one_of) {
    const bool moves = std::any_of(group.facts.begin(), group.facts.end(),
                                   [&](const std::string& fact) { return moving.contains(fact); });
    if (moves) moving.insert(group.facts.begin(), group.facts.end());
  }
  return moving;
}

Situation Executive::situation(const translate::Progress& progress, const model::NamedState& expected,
                               double time_s) const {
  Situation now;
  for (const std::size_t index : progress.failed_steps) {
    const translate::StepInfo& step = current_.translation.steps[index];
    if (step.action) {
      now.failed.push_back(failure_of(*step.action, time_s));
      continue;
    }
    FailedAction start;
    start.reason = FailedAction::Reason::Refused;
    start.sentence = "the plant is not in the state in which the plan starts";
    now.failed.push_back(std::move(start));
  }
  now.moving = moving_atoms(progress);
  // Of what failed, its own half-way levels are evidence, too.
  now.differences = translate::differences(planning_.binding(), expected, seen_.measured,
                                           now.failed.empty() ? now.moving : std::set<std::string>());
  if (!now.failed.empty()) now.contradictions = seen_.contradictions;
  now.earlier = earlier_;
  now.left = left_;
  now.just_changed = just_changed_;
  now.limited = limited_;
  now.drift = drift_.found();
  for (const run::Alarm& alarm : alarms_) {
    if (alarm.kind == to_string(translate::MonitorKind::Motion)) now.frozen.push_back(alarm.sensor);
    if (alarm.kind == to_string(translate::MonitorKind::Rate)) now.leapt.push_back(alarm.sensor);
    if (alarm.kind == to_string(translate::MonitorKind::Standstill))
      now.failed.push_back(standstill_of(alarm));
  }
  return now;
}

// What it drives and needs; not yet why it failed.
FailedAction Executive::failing(const model::GroundAction& action) const {
  FailedAction failed;
  failed.text = model::to_string(action);
  translate::Assignment assignment;
  failed.outputs = planning_.binding().action_for(action, assignment)->outputs;
  failed.devices = planning_.binding().devices_of(action);
  return failed;
}

// Pump, valve or sensor: which of them, one level alone cannot tell.
FailedAction Executive::standstill_of(const run::Alarm& alarm) const {
  const auto& actions = current_.plan.actions;
  const auto action = std::ranges::find(
      actions, alarm.action, [](const model::GroundAction& each) { return model::to_string(each); });
  FailedAction failed;
  if (action != actions.end()) failed = failing(*action);
  failed.text = alarm.action;
  failed.reason = FailedAction::Reason::NoEffect;
  const auto sensor = std::ranges::find(planning_.binding().sensors, alarm.sensor, &translate::Sensor::name);
  failed.sentence =
      fmt::format("{} has stopped halfway: the {} stands still though {} {} on", alarm.action, sensor->label,
                  fmt::join(failed.outputs, " and "), failed.outputs.size() == 1 ? "is" : "are");
  return failed;
}

// Empty of a monitor that watches all the time.
std::string Executive::watched_action(const translate::Monitor& monitor) const {
  return monitor.action ? model::to_string(current_.plan.actions[*monitor.action]) : std::string();
}

// Alarms that the program's monitors have raised since the last look.
void Executive::note_alarms(std::span<const std::byte> image) {
  if (!alarm_reader_) return;
  const auto values = alarm_reader_->values(image);
  const auto count = static_cast<std::size_t>(values.at(translate::kAlarmCount));
  if (count == alarms_seen_) return;
  alarms_seen_ = count;
  for (std::size_t i = 0; i < current_.translation.monitors.size(); ++i) {
    const double scan = values.at(translate::alarm_scan_variable(i));
    if (scan == 0.0 || !alarms_told_.insert(i).second) continue;
    const translate::Monitor& monitor = current_.translation.monitors[i];
    run::Alarm alarm{watched_action(monitor),
                     to_string(monitor.kind),
                     monitor.text,
                     static_cast<std::uint64_t>(scan),
                     values.at(translate::alarm_value_variable(i)),
                     monitor.sensor};
    for (const translate::Sensor& sensor : planning_.binding().sensors) {
      if (sensor.name != monitor.sensor) continue;
      alarm.value = sensor.calibration.value_at(alarm.value - translate::tare_of(tare_, sensor));
    }
    alarms_.push_back(std::move(alarm));
  }
}

// What a journal tells of the program that still runs. A monitor raises its alarm once.
void Executive::note_told_alarms() {
  for (const run::Incident& incident : record_.incidents) {
    if (incident.time_s < record_.episodes.back().started_s) continue;
    for (const run::Alarm& told : incident.alarms) {
      for (std::size_t i = 0; i < current_.translation.monitors.size(); ++i) {
        const translate::Monitor& monitor = current_.translation.monitors[i];
        const bool same = told.action == watched_action(monitor) && told.kind == to_string(monitor.kind) &&
                          told.condition == monitor.text;
        if (same) alarms_told_.insert(i);
      }
    }
  }
}

// In START the filters still swing in; the chart itself checks the initial state when it leaves that step.
bool Executive::settled(const std::vector<bool>& active) const {
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (active[i] && current_.translation.steps[i].kind == translate::StepKind::Start) return false;
  }
  return true;
}

void Executive::note_progress(const translate::Progress& progress, double time_s) {
  std::vector<run::ActionRecord>& actions = record_.episodes.back().actions;
  just_changed_.clear();
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const run::ActionState state = progress.actions[i];
    if (state == actions[i].state) continue;
    // An action that could not start never began.
    const bool began = actions[i].state == run::ActionState::Pending && state != run::ActionState::Failed;
    actions[i].state = state;
    if (began) {
      actions[i].started_s = time_s;
      // What is not measured stands as it was planned before the action.
      model::NamedState before = current_.run.actions[i].before;
      for (const auto& [fluent, value] : seen_.measured.fluents) {
        if (planning_.binding().sensor_of(fluent) != nullptr) before.fluents[fluent] = value;
      }
      actions[i].actual_cost = planning_.cost_of(current_.run.actions[i].action, before);
    }
    if (state != run::ActionState::Done) continue;
    note_done(i, time_s);
    just_changed_.merge(translate::changed_atoms(current_.run.actions[i]));
  }
}

void Executive::note_done(std::size_t action, double time_s) {
  run::ActionRecord& record = record_.episodes.back().actions[action];
  record.finished_s = time_s;
  record_.finished_s = time_s;
  devices_.clear(planning_.binding().devices_of(current_.plan.actions[action]));
  for (const translate::Sensor& sensor : planning_.binding().sensors) {
    record.observed[sensor.fluent] = seen_.measured.fluents.at(sensor.fluent);
  }
}

// Why the chart left an action for its FAILED step. It does so when the precondition is not observed before
// the start, when the timeout has passed, when its outputs do nothing, or when a fact that must hold is lost;
// the record tells which.
FailedAction Executive::failure_of(std::size_t action, double time_s) const {
  using Reason = FailedAction::Reason;
  const run::ActionRecord& record = record_.episodes.back().actions[action];
  FailedAction failed;
  failed.text = record.text;
  if (!record.started_s) {
    failed.reason = Reason::Refused;
    failed.sentence = record.text + (unwatched_ ? " could not start or did not end while nobody watched"
                                                : " could not start: its precondition is not observed");
    return failed;
  }
  translate::Assignment assignment;
  const translate::ActionBinding* entry =
      planning_.binding().action_for(current_.plan.actions[action], assignment);
  failed = failing(current_.plan.actions[action]);
  const double timeout_s = std::chrono::duration<double>(entry->timeout).count();
  // The chart's clock of a step and the events' times agree to a scan.
  const double scan_s = static_cast<double>(planning_.options().interval_us) * 1e-6;
  const double ran_s = time_s - *record.started_s;
  if (ran_s >= timeout_s - scan_s) {
    failed.reason = Reason::Timeout;
    failed.sentence = fmt::format("{} did not end within {:g} s", record.text, timeout_s);
    return failed;
  }
  for (const translate::Pattern& pattern : entry->hold) {
    const translate::ObservedFact* fact = planning_.binding().observed(instantiate(pattern, assignment));
    if (!seen_.measured.facts.contains(fact->fact)) failed.lost_facts.push_back("'" + fact->label + "'");
  }
  if (!failed.lost_facts.empty()) {
    failed.reason = Reason::LostHold;
    failed.sentence = fmt::format("{} was stopped: {} was lost while it ran", record.text,
                                  fmt::join(failed.lost_facts, " and "));
    return failed;
  }
  const auto step = current_.translation.step(record.step);
  const double idle_s = std::chrono::duration<double>(current_.translation.steps[*step].idle).count();
  if (idle_s > 0.0 && ran_s >= idle_s - 1.5 * scan_s) {
    failed.reason = Reason::NoEffect;
    failed.sentence = fmt::format("{} had no effect in {:g} s: {} was on", record.text, idle_s,
                                  fmt::join(failed.outputs, " and "));
    return failed;
  }
  failed.sentence = record.text + " was stopped before its end";  // lost and back within a scan
  return failed;
}

std::optional<run::Cause> Executive::due(double time_s) {
  const std::vector<GoalChange> due = requests_.take(time_s);
  if (due.empty()) return std::nullopt;
  run::Cause cause;
  cause.kind = run::IncidentKind::ChangedDemand;
  for (const GoalChange& change : due) {
    if (!change.goal.empty()) {
      goal_ = change.goal;
      cause.kind = run::IncidentKind::NewGoal;
      cause.evidence.push_back("the goal was changed to " + goal_);
      continue;
    }
    changed_[change.fluent] = change.value;
    cause.evidence.push_back(change.fluent + " was changed to " + pddl::number_text(change.value));
  }
  return cause;
}

// `resting`: with those of which only the rest runs.
std::vector<model::GroundAction> Executive::begun_actions(bool resting) const {
  std::vector<model::GroundAction> actions;
  for (std::size_t i = 0; i < progress_.actions.size(); ++i) {
    const bool runs = progress_.actions[i] == run::ActionState::Active && (resting || !progress_.rests(i));
    if (runs || progress_.actions[i] == run::ActionState::Failed) {
      actions.push_back(current_.plan.actions[i]);
    }
  }
  return actions;
}

model::NamedState Executive::with_changes(model::NamedState state) const {
  for (const auto& [fluent, value] : changed_) state.fluents[fluent] = value;
  return state;
}

}  // namespace stepwright::executive
