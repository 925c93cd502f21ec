// From start to end.

#include "supervisor/tamp/mission/arms_mission.h"

#include <fmt/format.h>

#include <utility>

#include "supervisor/tamp/mission/arms_journal.h"

namespace stepwright::tamp::mission {

using run::IncidentKind;
using run::Phase;

ArmsMission::ArmsMission(const ArmsPlanning& planning, run::Controller& controller,
                         ArmsMissionOptions options, Observer observer)
    : MovingMission(controller, {options.cell, options.barrier, options.operator_starts},
                    {options.max_replans, options.attended, options.hold},
                    {.what = "the arms",
                     .many = true,
                     .rests = "the arms stand",
                     .until = "they are resumed",
                     .another = "another order",
                     .stopped = "the program was stopped while the arms were held"},
                    std::move(observer)),
      planning_(planning),
      options_(std::move(options)),
      held_(planning.cell().arms.size(), -1),
      requests_(options_.requests) {
  for (const scene::Thing& each : planning.cell().things) believed_.push_back(each.start);
  take_order(planning.first_order());
}

void ArmsMission::take_order(ArmsOrder order) {
  order_ = std::move(order);
  record_.goal.clear();
  for (const Wanted& each : order_.wanted) record_.goal.push_back({text_of(planning_.cell(), each), false});
  note_outlook();
}

// A further run has the same order once more, or the one that was asked for since.
bool ArmsMission::begin() {
  if (std::exchange(ran_, true)) {
    forget_run();
  } else if (const auto resumed = resume()) {
    return *resumed;
  }
  show_plan();
  return begin_from_rest("the arms wait for a look at their cell");
}

// Things stand where they were left, and the clock goes on; the rest was of the run before.
void ArmsMission::forget_run() {
  begin_record();
  take_order(std::move(order_));
  driven_.reset();
  reader_.reset();
  tries_.clear();
  fault_.reset();
  met_.reset();
  hold_.forget();
}

// After a restart of the supervisor the program of the plan goes on by itself and is followed to its end,
// which the camera judges; else the arms rest, and are planned for anew. Nothing: no run was interrupted.
std::optional<bool> ArmsMission::resume() {
  if (options_.journal.empty()) return std::nullopt;
  auto journal = read_arms_journal(options_.journal);
  if (!journal) return give_up(result::to_string(journal.error()), IncidentKind::ProgramFault);
  if (!*journal) return std::nullopt;
  ArmsJournal& known = **journal;
  const bool ended = known.record.phase == Phase::Done || known.record.phase == Phase::Safe;
  if (ended || known.record.episodes.empty()) return std::nullopt;
  auto order = planning_.order(known.order);
  if (!order) return give_up("the journal is of another cell", IncidentKind::ProgramFault);
  const scene::RobotCell& cell = planning_.cell();
  record_ = std::move(known.record);
  take_order(*std::move(order));
  for (const auto& [name, pose] : known.believed)
    if (const int thing = cell.thing(name); thing >= 0) believed_[static_cast<std::size_t>(thing)] = pose;
  for (const auto& [arm, name] : known.held)
    if (const int number = cell.arm(arm); number >= 0)
      held_[static_cast<std::size_t>(number)] = cell.thing(name);
  tries_ = std::move(known.tries);
  looks_ = known.looks;
  clock_ = run::RunClock(known.clock);
  requests_.go_on_at(known.next_request);
  set_phase(Phase::Waiting, "the supervisor was restarted and looks for its runtime");
  if (!await_runtime()) return false;
  const auto status = controller_.status();
  const run::Cause cause{IncidentKind::LostSupervisor,
                         {"the supervisor was restarted; what its program has done is looked at"}};
  if (status && status->program_digest == record_.episodes.back().digest &&
      status->state == host::RuntimeState::Running) {
    digest_ = status->program_digest;
    const auto container = controller_.program();
    const auto looking = planning_.observe(1);  // has the same names
    auto reader = container && looking ? ArmsReader::create(*container, cell, looking->program.variables)
                                       : result::Result<ArmsReader>(tl::unexpected(result::Diagnostics()));
    if (reader) {
      reader_ = *std::move(reader);
      kind_ = Kind::Follow;
      (void)controller_.acknowledge(status->last_event);  // the clock may stand still at it
      open_incident(cause);
      decide(run::Response::GoOn);
      set_phase(Phase::Executing, "the arms go on with the plan that they have");
      return true;
    }
  }
  return replan(cause);
}

// The program runs without anybody who follows it: a runtime that has it still goes on.
bool ArmsMission::recover_runtime() {
  if (has_gone_on()) return true;
  if (record_.phase == Phase::Safe) return false;
  driven_.reset();
  return replan(
      {IncidentKind::LostRuntime, {"the runtime was restarted or stopped while nobody watched it"}});
}

// The camera has the last word.
bool ArmsMission::finish() {
  // A program that has ended has done all of its plan, also what nobody followed.
  if (!driven_ && kind_ == Kind::Follow && reading_.stage == CellStage::Done)
    for (run::ActionRecord& action : record_.episodes.back().actions)
      if (action.state != run::ActionState::Failed) action.state = run::ActionState::Done;
  set_phase(Phase::Observing, driven_ && driven_->retreats ? "the camera looks at what the arm has met"
                                                           : "the camera looks whether it is done");
  return plan_from_rest();
}

void ArmsMission::publish(bool now) {
  if (now || std::exchange(changed_, false)) write_journal();
  tell();
}

void ArmsMission::write_journal() const {
  if (options_.journal.empty() || record_.episodes.empty()) return;
  const scene::RobotCell& cell = planning_.cell();
  ArmsJournal journal;
  journal.record = record_;
  journal.clock = clock_.state();
  journal.next_request = requests_.next();
  journal.order = order_.name;
  for (std::size_t k = 0; k < believed_.size(); ++k) journal.believed[cell.things[k].name] = believed_[k];
  for (std::size_t arm = 0; arm < held_.size(); ++arm)
    if (held_[arm] >= 0)
      journal.held[cell.arms[arm].name] = cell.things[static_cast<std::size_t>(held_[arm])].name;
  journal.tries = tries_;
  journal.looks = looks_;
  // A journal that cannot be written costs a restart its memory, not this run.
  (void)write_arms_journal(options_.journal, journal);
}

}  // namespace stepwright::tamp::mission
