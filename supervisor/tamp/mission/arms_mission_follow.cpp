// Watching one plan: events, progress, and what the camera sees meanwhile.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::tamp::mission {

using run::ActionState;
using run::Decision;
using run::IncidentKind;
using schedule::ScheduledStep;
using schedule::StepKind;

namespace {

constexpr double kMoved_m = 0.012;      // six deviations of a report
constexpr double kStranger_m = 0.06;    // from all that is expected
constexpr double kSamePlace_m = 0.015;  // of two reports of one thing: five deviations of their difference
constexpr std::size_t kAgreeing = 2;    // reports, one after the other

double apart(const scene::Pose& a, const scene::Pose& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

}  // namespace

void ArmsMission::see(std::span<const std::byte> image) {
  reading_ = reader_->read(image);
  record_.observed.clear();
  // A program shows what the one before has left, until it begins.
  if (kind_ != Kind::Look && reading_.stage != CellStage::Begins) {
    came_.clear();
    for (const ArmReading& each : reading_.arms) came_.push_back(each.progress);
  }
  for (std::size_t arm = 0; arm < reading_.arms.size(); ++arm)
    record_.observed["progress_" + planning_.cell().arms[arm].name] = reading_.arms[arm].progress;
}

Decision ArmsMission::judge_image(std::span<const std::byte> image) {
  see(image);
  // In its first scan a program still shows what the one before has left.
  if (reading_.stage != CellStage::Begins) note_progress();
  if (auto cause = due(clock_.now_s())) return {run::Verdict::Replan, *std::move(cause)};
  if (!reading_.estop_ok ||
      (reading_.stage == CellStage::Stopped && reading_.cause == program::StopCause::EmergencyStop)) {
    if (options_.attended) return {run::Verdict::Hold};
    return run::give_up_because(IncidentKind::Operator, "the emergency stop is pressed");
  }
  if (reading_.stage == CellStage::Stopped) {
    // A drive's fault is told by how its joints were when it came.
    if (!fault_ && reading_.cause == program::StopCause::DriveFault) fault_ = surprise();
    Surprise what = fault_ ? *fault_ : surprise();
    // A plan begins at rest; news comes until then.
    return what.ends || reading_.rest ? answer(std::move(what)) : Decision{};
  }
  if (reading_.stage == CellStage::Done) return {run::Verdict::Finished};
  if (reading_.stage != CellStage::Works) return {};
  if (!take_report(image)) return {};
  if (auto moved = moved_thing()) {
    newest_.clear();
    return answer(
        {{IncidentKind::Position, {*moved + " was moved: it does not stand where it stood"}}, *moved});
  }
  if (const auto seen = new_obstacle()) {
    newest_.clear();
    return answer(
        {{IncidentKind::Position,
          {fmt::format("an obstacle stands in the way, at {:.2f} {:.2f} m", seen->pose.x_m, seen->pose.y_m)}},
         "what stands in the way"});
  }
  return {};
}

// The step that an arm is at; null: it is done, or nobody knows its schedule.
const ScheduledStep* ArmsMission::step_of(std::size_t arm) const {
  if (!driven_) return nullptr;
  const auto& steps = driven_->schedule.arms[arm].steps;
  const auto k = static_cast<std::size_t>(std::max(0.0, reading_.arms[arm].progress));
  return k < steps.size() ? &steps[k] : nullptr;
}

// By the schedule; -1: nothing.
int ArmsMission::held_by(std::size_t arm) const {
  if (!driven_) return held_[arm];
  const schedule::ArmSchedule& all = driven_->schedule.arms[arm];
  int holds = all.holds;
  const auto done = static_cast<std::size_t>(std::max(0.0, reading_.arms[arm].progress));
  for (std::size_t k = 0; k < std::min(done, all.steps.size()); ++k) {
    if (all.steps[k].kind == StepKind::Grip) holds = all.steps[k].thing;
    if (all.steps[k].kind == StepKind::Release) holds = -1;
  }
  return holds;
}

void ArmsMission::note_progress() {
  if (kind_ != Kind::Follow || !driven_) return;
  auto& actions = record_.episodes.back().actions;
  const bool changed_before = std::exchange(changed_, false);
  const schedule::CellSchedule& schedule = driven_->schedule;
  for (std::size_t arm = 0; arm < schedule.arms.size(); ++arm) {
    const auto& steps = schedule.arms[arm].steps;
    const double progress = reading_.arms[arm].progress;
    if (const int holds = held_by(arm); holds != held_[arm]) {
      held_[arm] = holds;
      changed_ = true;
    }
    for (std::size_t k = 0; k < steps.size(); ++k) {
      run::ActionRecord& action = actions[steps[k].action];
      const auto begins = static_cast<double>(k);
      if (progress <= begins || action.state == ActionState::Done) continue;
      if (action.state == ActionState::Pending) {
        action.state = ActionState::Active;
        action.started_s = clock_.now_s();
        changed_ = true;
      }
      const bool last = k + 1 == steps.size() || steps[k + 1].action != steps[k].action;
      if (!last || progress < begins + 1.0) continue;
      action.state = ActionState::Done;
      action.finished_s = clock_.now_s();
      record_.finished_s = *action.finished_s;
      action.actual_cost = action.planned_cost;
      changed_ = true;
      const scene::PlannedAction& done = driven_->plan.actions[steps[k].action];
      if (done.what.kind == scene::ActionKind::Place) believed_[at(done.what.thing)] = done.pose;
    }
  }
  if (changed_) note_outlook();
  changed_ = changed_ || changed_before;
}

// Where each thing stands by the plan; nothing: a hand has it, or is about to.
std::vector<std::optional<scene::Pose>> ArmsMission::expected() const {
  std::vector<std::optional<scene::Pose>> poses(believed_.size());
  for (std::size_t k = 0; k < believed_.size(); ++k) poses[k] = driven_->start.things[k].pose;
  for (std::size_t arm = 0; arm < driven_->schedule.arms.size(); ++arm) {
    const schedule::ArmSchedule& all = driven_->schedule.arms[arm];
    if (all.holds >= 0) poses[at(all.holds)].reset();
  }
  // In the order of the plan's actions; an action ends with its arm's last step of it.
  for (std::size_t number = 0; number < driven_->plan.actions.size(); ++number) {
    const scene::PlannedAction& action = driven_->plan.actions[number];
    const std::size_t arm = at(action.what.arm);
    const auto& steps = driven_->schedule.arms[arm].steps;
    const double progress = reading_.arms[arm].progress;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (steps[k].action != number) continue;
      if (steps[k].kind == StepKind::Grip && progress >= static_cast<double>(k))
        poses[at(action.what.thing)].reset();
      if (steps[k].kind == StepKind::Release && progress >= static_cast<double>(k + 1))
        poses[at(action.what.thing)] = action.pose;
    }
  }
  return poses;
}

// Whether there are two reports of this plan, one of them new.
bool ArmsMission::take_report(std::span<const std::byte> image) {
  if (!driven_ || reading_.reports == seen_reports_) return false;
  seen_reports_ = reading_.reports;
  newest_.push_back(reader_->newest(image));
  if (newest_.size() > kAgreeing) newest_.erase(newest_.begin());
  return newest_.size() == kAgreeing;
}

// Its name, if two reports agree that it is elsewhere, and both have something of its kind at the same place,
// where nothing is expected. What is not there is seen once and not again.
std::optional<std::string> ArmsMission::moved_thing() const {
  const scene::RobotCell& cell = planning_.cell();
  const auto poses = expected();
  std::vector<scene::Pose> known;
  for (const auto& each : poses)
    if (each) known.push_back(*each);
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    const motion::Vector3 tool = tool_of(cell.arms[arm], reading_.arms[arm].joints).position_m;
    known.push_back({tool.x, tool.y, tool.z, 0.0});
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (!poses[k]) continue;
    const auto same = [&](const Seen& each) { return each.kind == kind_of(cell.things[k]); };
    const bool there = std::ranges::any_of(newest_, [&](const Report& report) {
      return std::ranges::any_of(
          report, [&](const Seen& each) { return same(each) && apart(each.pose, *poses[k]) < kMoved_m; });
    });
    const auto elsewhere = [&](const Seen& each) {
      return same(each) && std::ranges::all_of(known, [&](const scene::Pose& pose) {
               // A little away from where it stood is elsewhere, too.
               const bool own = pose.x_m == poses[k]->x_m && pose.y_m == poses[k]->y_m;
               return apart(each.pose, pose) > (own ? kMoved_m : kStranger_m);
             });
    };
    const bool moved = !there && std::ranges::any_of(newest_.front(), [&](const Seen& first) {
      return elsewhere(first) && std::ranges::any_of(newest_.back(), [&](const Seen& next) {
               return elsewhere(next) && apart(first.pose, next.pose) < kSamePlace_m;
             });
    });
    if (moved) return cell.things[k].name;
  }
  return std::nullopt;
}

}  // namespace stepwright::tamp::mission
