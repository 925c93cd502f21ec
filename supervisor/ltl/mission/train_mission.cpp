// From start to end.

#include "supervisor/ltl/mission/train_mission.h"

#include <fmt/format.h>

#include <utility>

#include "supervisor/ltl/mission/train_journal.h"

namespace stepwright::ltl {

using run::IncidentKind;
using run::Phase;

TrainMission::TrainMission(const TrainPlanning& planning, run::Controller& controller,
                           TrainMissionOptions options, Observer observer)
    : MovingMission(controller, {options.cell, options.barrier, options.operator_starts},
                    {options.max_replans, options.attended, options.hold},
                    {.what = "the train",
                     .rests = "the train rests",
                     .until = "it is resumed",
                     .another = "another task",
                     .stopped = "the program was stopped while the train was held"},
                    std::move(observer)),
      planning_(planning),
      options_(std::move(options)),
      pictures_(planning),
      requests_(options_.requests) {
  take_task(planning.first_task());
}

void TrainMission::take_task(TrainTask task) {
  task_ = std::move(task);
  state_ = task_.begins();
  record_.goal = {{task_.text, false}};
}

// A further run has the same task once more, or the one that was asked for since, however the one before has
// ended.
bool TrainMission::begin() {
  if (std::exchange(ran_, true)) {
    forget_run();
  } else if (const auto resumed = resume()) {
    return *resumed;
  }
  pictures_.clear();
  draw();
  return begin_from_rest("the train waits for its plan");
}

// What stands on the floor stays there, and the clock goes on; the rest was of the run before.
void TrainMission::forget_run() {
  begin_record();
  record_.goal = {{task_.text, false}};
  state_ = task_.begins();
  driven_.reset();
  reader_.reset();
  hold_.forget();
}

// After a restart of the supervisor: the runtime may drive on, or have gone to its safe state. The train is
// brought to rest and goes on from there, behind what the monitor has seen. Nothing: no run was interrupted.
std::optional<bool> TrainMission::resume() {
  if (options_.journal.empty()) return std::nullopt;
  auto journal = read_train_journal(options_.journal);
  if (!journal) return give_up(result::to_string(journal.error()), IncidentKind::ProgramFault);
  if (!*journal) return std::nullopt;
  TrainJournal& known = **journal;
  const bool ended = known.record.phase == Phase::Done || known.record.phase == Phase::Safe;
  if (ended || known.record.episodes.empty()) return std::nullopt;
  auto task = planning_.task(known.task);
  if (!task || known.state >= task->monitor.size())
    return give_up("the journal is of another floor", IncidentKind::ProgramFault);
  record_ = std::move(known.record);
  task_ = *std::move(task);
  watched_ = known.watched;
  state_ = known.state;
  blocked_ = std::move(known.blocked);
  clock_ = run::RunClock(known.clock);
  requests_.go_on_at(known.next_request);
  set_phase(Phase::Waiting, "the supervisor was restarted and looks for its runtime");
  if (!await_runtime()) return false;
  const auto status = controller_.status();
  if (status && status->program_digest == record_.episodes.back().digest) {
    digest_ = status->program_digest;
    const auto container = controller_.program();
    const auto info =
        container ? reader::ProgramInfo::read(*container) : tl::unexpected(result::Diagnostics());
    const auto snapshot = controller_.snapshot();
    const reader::Variable* state = info ? info->find(kTaskState) : nullptr;
    if (watched_ == task_.text && state != nullptr && snapshot && snapshot->program_digest == digest_)
      state_ = static_cast<std::uint32_t>(reader::read_number(*state, snapshot->image));
    if (state_ >= task_.monitor.size()) state_ = known.state;
  }
  return replan({IncidentKind::LostSupervisor, {"the supervisor was restarted; the train plans from rest"}});
}

// The program runs without anybody who follows it: a runtime that has it still goes on.
bool TrainMission::recover_runtime() {
  if (has_gone_on()) return true;
  if (record_.phase == Phase::Safe) return false;
  return replan(
      {IncidentKind::LostRuntime, {"the runtime was restarted or stopped while nobody watched it"}});
}

bool TrainMission::finish() {
  record_.goal.front().met = true;
  record_.finished_s = clock_.now_s();
  (void)controller_.stop("the task is done");
  set_phase(Phase::Done, fmt::format("the task is done: {}", task_.text));
  return false;
}

void TrainMission::publish(bool now) {
  if (now || std::exchange(changed_, false)) write_journal();
  tell();
}

void TrainMission::write_journal() const {
  if (options_.journal.empty() || record_.episodes.empty()) return;
  TrainJournal journal;
  journal.record = record_;
  journal.clock = clock_.state();
  journal.next_request = requests_.next();
  journal.task = task_.text;
  journal.watched = watched_;
  journal.state = state_;
  journal.blocked = blocked_;
  // A journal that cannot be written costs a restart its memory, not this run.
  (void)write_train_journal(options_.journal, journal);
}

}  // namespace stepwright::ltl
