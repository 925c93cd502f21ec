// Watching one plan: events, progress, and what comes between.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/ltl/mission/train_mission.h"

namespace stepwright::ltl {

using geometry::Point;
using run::ActionState;
using run::Cause;
using run::Decision;
using run::IncidentKind;

namespace {

constexpr double kFree_m = 0.6;   // between the car and what it halted for, at least
constexpr double kAside_m = 0.3;  // that what stands there may be wider than the train, to each side
constexpr double kShrink_m = 0.1;

Area box(std::string name, Point middle, Point ahead, double half_length_m, double half_width_m) {
  const Point along = half_length_m * ahead;
  const Point aside = half_width_m * Point{-ahead.y_m, ahead.x_m};
  return {.name = std::move(name),
          .ring = {middle + along + aside, middle - along + aside, middle - along - aside,
                   middle + along - aside},
          .where = {}};
}

const char* sentence(std::uint32_t error) {
  switch (error) {
    case 21:
      return "the train is off its way";
    case 22:
      return "the train does not move";
    case 24:
      return "the emergency stop is pressed";
    case 25:
      return "the train has met something";
    case 26:
      return "the navigation shows the same for ever";
    case 27:
      return "the navigation is not where the wheels lead";
    case 30:
      return "the navigation walks away from the wheels";
    case 31:
      return "a hitch is about to fold";
    default:
      return "the train has stopped by itself";
  }
}

}  // namespace

Decision TrainMission::judge_image(std::span<const std::byte> image) {
  const TrainReading before = reading_;
  see(image);
  record_.observed = {{"arc_m", reading_.arc_m},
                      {"trailers", static_cast<double>(reading_.trailers)},
                      {"task_state", static_cast<double>(reading_.state)}};
  note_progress();
  if (auto cause = due(clock_.now_s())) return {run::Verdict::Replan, *std::move(cause)};
  if (reading_.verdict == Verdict::False)
    return run::give_up_because(IncidentKind::Position, "the task cannot be done any more: " + task_.text);
  if (reading_.error != 0 || !reading_.estop_ok) {
    if (options_.attended) return {run::Verdict::Hold};
    return {run::Verdict::GiveUp, stopped_by_itself()};
  }
  if (reading_.trailers != driven_->train.trailers) {
    if (before.trailers > reading_.trailers) leave_trailers(before);
    return {run::Verdict::Replan,
            {IncidentKind::Position,
             {fmt::format("{} trailers are coupled, the plan has {}", reading_.trailers,
                          driven_->train.trailers)}}};
  }
  switch (steps_[reading_.step].kind) {
    case TrainStepKind::Done:
      if (reading_.verdict == Verdict::True) return {run::Verdict::Finished};
      return {run::Verdict::Replan,
              {IncidentKind::Position, {"the way has ended, and the task is not done"}}};
    case TrainStepKind::Blocked:
      blocked_.push_back(in_the_way());
      return {run::Verdict::Replan,
              {IncidentKind::Position,
               {fmt::format("something stands in the way at ({:.1f} m, {:.1f} m)", reading_.pose.x_m,
                            reading_.pose.y_m)}}};
    case TrainStepKind::Deviated:
      return {run::Verdict::Replan,
              {IncidentKind::Position,
               {fmt::format("the task is in state {}, which the plan does not go through", reading_.state)}}};
    default:
      return {};
  }
}

Cause TrainMission::stopped_by_itself() const {
  return {
      reading_.error == 24 || !reading_.estop_ok ? IncidentKind::Operator : IncidentKind::FailedActuator,
      {fmt::format("{} at ({:.1f} m, {:.1f} m)", reading_.estop_ok ? sentence(reading_.error) : sentence(24),
                   reading_.pose.x_m, reading_.pose.y_m)}};
}

// Actions are the steps of the chart in which the train drives.
void TrainMission::note_progress() {
  auto& actions = record_.episodes.back().actions;
  for (std::size_t k = 0; k < actions.size(); ++k) {
    run::ActionRecord& action = actions[k];
    const std::size_t step = k + 1;  // behind the start
    if (reading_.step < step || action.state == ActionState::Done) continue;
    const TrainStepKind now = steps_[reading_.step].kind;
    const bool lost = now == TrainStepKind::Blocked || now == TrainStepKind::Deviated;
    if (action.state == ActionState::Pending && !lost) {
      changed_ = true;
      action.state = ActionState::Active;
      action.started_s = clock_.now_s();
    }
    if (reading_.step == step || lost || action.state != ActionState::Active) continue;
    changed_ = true;
    action.state = ActionState::Done;
    action.finished_s = clock_.now_s();
    record_.finished_s = *action.finished_s;
    action.actual_cost = action.planned_cost;
  }
}

// Trailers that were left stand where they stood; the last one that is coupled has come from there.
void TrainMission::leave_trailers(const TrainReading& before) {
  TrainModel train = planning_.options().problem.train;
  train.trailers = std::min(before.trailers, train.trailers);
  const LinkBoxes boxes = link_boxes(train, before.standing_state());
  for (std::size_t k = reading_.trailers + 1; k <= train.trailers; ++k)
    blocked_.push_back(box(fmt::format("trailer {}", k), boxes[k].middle, boxes[k].ahead,
                           0.5 * train.length_m - kShrink_m, 0.5 * train.width_m - kShrink_m));
}

// What the scanner has seen: somewhere ahead, as wide as it may be.
Area TrainMission::in_the_way() {
  const TrainModel& train = planning_.options().problem.train;
  const Point ahead{std::cos(reading_.pose.heading_rad), std::sin(reading_.pose.heading_rad)};
  const double near_m = 0.5 * train.length_m + kFree_m;
  const double far_m = 0.5 * train.length_m + options_.scanner_m;
  const Point middle = reading_.pose.position() + 0.5 * (near_m + far_m) * ahead;
  return box(fmt::format("in the way {}", ++blocks_), middle, ahead, 0.5 * (far_m - near_m),
             0.5 * train.width_m + kAside_m);
}

// Something that the scanner sees from here, and that plans go round.
bool TrainMission::stands_ahead() const {
  const Point here = reading_.pose.position();
  const Point ahead{std::cos(reading_.pose.heading_rad), std::sin(reading_.pose.heading_rad)};
  const double far_m = 0.5 * planning_.options().problem.train.length_m + options_.scanner_m + kFree_m;
  return std::ranges::any_of(blocked_, [&](const Area& area) {
    return std::ranges::any_of(area.ring, [&](Point corner) {
      return dot(corner - here, ahead) > 0.0 && geometry::distance(corner, here) < far_m;
    });
  });
}

}  // namespace stepwright::ltl
