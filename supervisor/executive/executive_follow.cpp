// Watching one program: events, progress, deviations.

#include <fmt/format.h>

#include <set>

#include "supervisor/executive/executive.h"
#include "supervisor/pddl/state.h"

namespace stepwright::executive {
std::string sentence_of(const std::vector<std::string>& causes) {
  return fmt::format("{}", fmt::join(causes, "; "));
}

Executive::Decision Executive::follow() {
  while (true) {
    if (abort_) return {Verdict::GiveUp, "aborted by the operator"};
    const auto event = controller_.wait_event(std::chrono::milliseconds(200));
    if (!event) {
      if (runtime_lost()) return {Verdict::RuntimeLost, "the runtime does not answer"};
      if (auto change = due_change(time_s_)) return {Verdict::Replan, *change};
      continue;
    }
    const Decision decision = judge(*event);
    if (decision.verdict != Verdict::GoOn) return decision;
    (void)controller_.acknowledge(event->sequence);  // a lost runtime shows in the next round
  }
}

Executive::Decision Executive::judge(const host::StepEvent& event) {
  // The old program drives the plant again, which knows nothing of this plan.
  if (event.kind == host::EventKind::RolledBack)
    return {Verdict::GiveUp, "the program trapped and was rolled back: " + event.detail};
  if (event.program_digest != digest_) return {};  // news of a program that was replaced since
  take_time(event.time_ns);
  switch (event.kind) {
    case host::EventKind::Started:
    case host::EventKind::Changed:
    case host::EventKind::RolledBack:
      return {};
    case host::EventKind::StepChange:
      return judge_steps(event.image, time_s_);
    case host::EventKind::Trap:
      return {Verdict::GiveUp, "the program trapped: " + event.detail};
    case host::EventKind::Stopped:
      break;
  }
  // Whoever stopped the plant on purpose does not want it to go on by itself.
  if (event.detail != host::kSupervisorLost)
    return {Verdict::GiveUp, "stopped from outside: " + event.detail};
  return {Verdict::Replan, "the runtime stopped: " + event.detail};
}

// A runtime that was restarted counts its time from zero again; the record's time goes on.
void Executive::take_time(std::int64_t time_ns) {
  const double time_s = static_cast<double>(time_ns) * 1e-9;
  if (time_s + time_offset_s_ < time_s_) time_offset_s_ = time_s_;
  time_s_ = time_s + time_offset_s_;
}

Executive::Decision Executive::judge_steps(std::span<const std::byte> image, double time_s) {
  const std::vector<bool> active = reader_->active_steps(image);
  const translate::Progress progress = translate::progress(current_.translation, active);
  progress_ = progress;
  const model::NamedState expected =
      with_changes(translate::expected_state(current_.translation, progress.done()));
  auto estimate =
      translate::estimate(desk_.binding(), reader_->values(image), tare_, expected, begun_actions());
  if (!estimate) return {Verdict::GiveUp, result::to_string(estimate.error())};
  seen_ = std::move(*estimate);
  note_progress(progress, time_s);
  for (const translate::Sensor& sensor : desk_.binding().sensors) {
    if (auto value = expected.fluents.find(sensor.fluent); value != expected.fluents.end()) {
      record_.expected[sensor.fluent] = value->second;
    }
    record_.observed[sensor.fluent] = seen_.measured.fluents.at(sensor.fluent);
  }
  record_.goal = desk_.goal_status(with_changes(seen_.planning));
  std::set<std::string> moving;
  for (std::size_t i = 0; i < progress.actions.size(); ++i) {
    if (progress.actions[i] != ActionState::Active && progress.actions[i] != ActionState::Failed) continue;
    for (const std::string& atom : translate::changed_atoms(current_.run.actions[i])) moving.insert(atom);
  }
  publish();
  if (!progress.failed_steps.empty()) return {Verdict::Replan, describe_failure(progress, time_s)};
  if (settled(active)) {
    const auto wrong = translate::deviations(desk_.binding(), expected, seen_.measured, moving);
    if (!wrong.empty()) return {Verdict::Replan, sentence_of(wrong)};
  }
  if (auto change = due_change(time_s)) return {Verdict::Replan, *change};
  return progress.finished ? Decision{Verdict::Finished, {}} : Decision{};
}

// In START the filters still swing in; the chart itself checks the initial state when it leaves that step.
bool Executive::settled(const std::vector<bool>& active) const {
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (active[i] && current_.translation.steps[i].kind == translate::StepKind::Start) return false;
  }
  return true;
}

void Executive::note_progress(const translate::Progress& progress, double time_s) {
  std::vector<ActionRecord>& actions = record_.episodes.back().actions;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const ActionState state = progress.actions[i];
    if (state == actions[i].state) continue;
    // An action that could not start never began.
    const bool began = actions[i].state == ActionState::Pending && state != ActionState::Failed;
    actions[i].state = state;
    if (began) {
      actions[i].started_s = time_s;
      // What is not measured stands as it was planned before the action.
      model::NamedState before = current_.run.actions[i].before;
      for (const auto& [fluent, value] : seen_.measured.fluents) {
        if (desk_.binding().sensor_of(fluent) != nullptr) before.fluents[fluent] = value;
      }
      actions[i].actual_cost = desk_.cost_of(current_.run.actions[i].action, before);
    }
    if (state == ActionState::Done) note_done(i, time_s);
  }
}

void Executive::note_done(std::size_t action, double time_s) {
  ActionRecord& record = record_.episodes.back().actions[action];
  record.finished_s = time_s;
  record_.finished_s = time_s;
  for (const translate::Sensor& sensor : desk_.binding().sensors) {
    record.observed[sensor.fluent] = seen_.measured.fluents.at(sensor.fluent);
  }
}

// Why the chart left an action for its FAILED step. It does so when the precondition is not observed before
// the start, when the timeout has passed, or when a fact that must hold is lost; the record tells which.
std::string Executive::failure_of(std::size_t action, double time_s) const {
  const ActionRecord& record = record_.episodes.back().actions[action];
  if (!record.started_s) {
    return record.text + (unwatched_ ? " could not start or did not end while nobody watched"
                                     : " could not start: its precondition is not observed");
  }
  translate::Assignment assignment;
  const translate::ActionBinding* entry =
      desk_.binding().action_for(current_.plan.actions[action], assignment);
  const double timeout_s = std::chrono::duration<double>(entry->timeout).count();
  // The chart's clock of a step and the events' times agree to a scan.
  const double scan_s = static_cast<double>(desk_.options().interval_us) * 1e-6;
  if (time_s - *record.started_s >= timeout_s - scan_s) {
    return fmt::format("{} did not end within {:g} s", record.text, timeout_s);
  }
  std::vector<std::string> lost;
  for (const translate::Pattern& pattern : entry->hold) {
    const translate::ObservedFact* fact = desk_.binding().observed(instantiate(pattern, assignment));
    if (!seen_.measured.facts.contains(fact->fact)) lost.push_back("'" + fact->label + "'");
  }
  if (lost.empty()) return record.text + " was stopped before its end";  // lost and back within a scan
  return fmt::format("{} was stopped: {} was lost while it ran", record.text, fmt::join(lost, " and "));
}

std::string Executive::describe_failure(const translate::Progress& progress, double time_s) const {
  std::vector<std::string> sentences;
  for (const std::size_t index : progress.failed_steps) {
    const translate::StepInfo& step = current_.translation.steps[index];
    sentences.push_back(step.action ? failure_of(*step.action, time_s)
                                    : "the plant is not in the state in which the plan starts");
  }
  const model::NamedState expected =
      with_changes(translate::expected_state(current_.translation, progress.done()));
  for (const std::string& sentence : translate::deviations(desk_.binding(), expected, seen_.measured)) {
    sentences.push_back(sentence);
  }
  for (const std::string& sentence : seen_.contradictions) sentences.push_back(sentence);
  return sentence_of(sentences);
}

std::optional<std::string> Executive::due_change(double time_s) {
  std::vector<GoalChange> due;
  {
    const std::lock_guard lock(requests_mutex_);
    due.swap(requests_);
  }
  for (; next_change_ < options_.goal_changes.size(); ++next_change_) {
    if (options_.goal_changes[next_change_].at_s > time_s) break;
    due.push_back(options_.goal_changes[next_change_]);
  }
  std::vector<std::string> sentences;
  for (const GoalChange& change : due) {
    changed_[change.fluent] = change.value;
    sentences.push_back(change.fluent + " was changed to " + pddl::number_text(change.value));
  }
  if (sentences.empty()) return std::nullopt;
  return sentence_of(sentences);
}

std::vector<model::GroundAction> Executive::begun_actions() const {
  std::vector<model::GroundAction> actions;
  for (std::size_t i = 0; i < progress_.actions.size(); ++i) {
    if (progress_.actions[i] == ActionState::Active || progress_.actions[i] == ActionState::Failed) {
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
