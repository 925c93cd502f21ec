// What has stopped the arms, in words, and what follows from it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::tamp::mission {

using program::StopCause;
using run::Decision;
using run::IncidentKind;

namespace {

constexpr double kBehind_rad = 0.15;    // a joint that does not follow is so far from its path
constexpr double kMoves_rad = 0.005;    // between two news
constexpr double kFingers_m = 0.004;    // fingers that move do it by more
constexpr double kArrived_rad = 0.015;  // a joint that is where a plan has ended is so near to it

}  // namespace

ArmsMission::Surprise ArmsMission::surprise() const {
  const std::size_t last = planning_.cell().arms.size() - 1;
  const std::size_t arm = std::min(last, static_cast<std::size_t>(std::max(0, reading_.cause_arm)));
  const std::string who = planning_.cell().arms[arm].name;
  const schedule::ScheduledStep* step = step_of(arm);
  const std::string thing = step != nullptr && step->thing >= 0
                                ? planning_.cell().things[static_cast<std::size_t>(step->thing)].name
                                : std::string("what it was to grasp");
  const auto made = [](IncidentKind kind, std::string sentence, std::string about, bool ends = false) {
    return Surprise{{kind, {std::move(sentence)}}, std::move(about), ends};
  };
  switch (reading_.cause) {
    case StopCause::MissedGrasp: {
      const bool closed =
          step == nullptr || reading_.arms[arm].width_m < 2.0 * step->half_open_m + kFingers_m;
      if (!closed)
        return made(IncidentKind::FailedActuator, fmt::format("the fingers of the {} hand do not close", who),
                    who + " fingers");
      return made(IncidentKind::Position,
                  fmt::format("the {} hand has closed and does not hold {}", who, thing), thing);
    }
    case StopCause::LostGrasp:
      return made(IncidentKind::Position, fmt::format("{} has slipped out of the {} hand", thing, who),
                  thing);
    case StopCause::DriveFault:
      return drive_fault(arm, who);
    case StopCause::Interlock:
      return made(IncidentKind::Position,
                  "the arms came too near to each other, and the interlock has stopped them", "interlock");
    case StopCause::NotAtStart:
      return made(IncidentKind::Position, fmt::format("the {} arm is not where its plan begins", who),
                  who + " start");
    case StopCause::Refused:
      return made(IncidentKind::Refused,
                  fmt::format("a command of the {} arm was refused, error {}", who, reading_.arms[arm].error),
                  who + " commands");
    case StopCause::Fingers:
      return made(IncidentKind::FailedActuator,
                  fmt::format("the fingers of the {} hand do not come to their opening", who),
                  who + " fingers");
    default:
      return made(IncidentKind::ProgramFault, "the arms have stopped by themselves", "arms");
  }
}

// A joint that stays where it is in spite of its set points is stuck, unless something holds it.
ArmsMission::Surprise ArmsMission::drive_fault(std::size_t arm, const std::string& who) const {
  Surprise made{{IncidentKind::FailedActuator, {fmt::format("a drive of the {} arm has tripped", who)}},
                "the way of the " + who + " arm",
                false,
                static_cast<int>(arm)};
  const schedule::ScheduledStep* step = step_of(arm);
  if (step == nullptr || !step->motion) return made;
  const double share = reading_.arms[arm].progress - std::floor(reading_.arms[arm].progress);
  motion::Configuration planned(7);
  step->motion->path.at(step->motion->law.at(share * step->duration_s).place, planned);
  double worst_rad = kBehind_rad;
  for (std::size_t j = 0; j < planned.size(); ++j) {
    const double now_rad = reading_.arms[arm].joints[j];
    const double off_rad = std::abs(planned[j] - now_rad);
    if (off_rad <= worst_rad) continue;
    worst_rad = off_rad;
    const bool moves = std::abs(now_rad - before_.arms[arm].joints[j]) > kMoves_rad;
    made.cause.evidence = {
        moves ? fmt::format("joint {} of the {} arm has left its path by {:.2f} rad", j + 1, who, off_rad)
              : fmt::format("joint {} of the {} arm does not move, {:.2f} rad behind its path: it is stuck",
                            j + 1, who, off_rad)};
    made.cause.devices = {fmt::format("{} joint {}", who, j + 1)};
  }
  return made;
}

// The joint that is farthest from where the plan that has ended has it. One that is stuck near the end of its
// path is never far enough from it for its drive to trip.
std::optional<ArmsMission::Surprise> ArmsMission::short_of_end() const {
  if (!driven_) return std::nullopt;
  std::optional<Surprise> found;
  double worst_rad = kArrived_rad;
  for (std::size_t arm = 0; arm < driven_->schedule.arms.size(); ++arm) {
    const schedule::ArmSchedule& all = driven_->schedule.arms[arm];
    motion::Configuration end = all.start;
    for (const schedule::ScheduledStep& each : all.steps)
      if (each.motion) end = each.motion->path.points().back();
    for (std::size_t j = 0; j < end.size(); ++j) {
      const double off_rad = std::abs(end[j] - reading_.arms[arm].joints[j]);
      if (off_rad <= worst_rad) continue;
      worst_rad = off_rad;
      const std::string joint = fmt::format("joint {} of the {} arm", j + 1, planning_.cell().arms[arm].name);
      found = Surprise{{IncidentKind::FailedActuator,
                        {fmt::format("the plan has ended, and {} is {:.2f} rad short of the end of its path",
                                     joint, off_rad)}},
                       joint};
      found->cause.devices = {fmt::format("{} joint {}", planning_.cell().arms[arm].name, j + 1)};
    }
  }
  return found;
}

Decision ArmsMission::answer(Surprise what) {
  if (what.ends) return {run::Verdict::GiveUp, std::move(what.cause)};
  if (what.arm >= 0) {  // judged by what is seen there (judge_fault)
    fault_ = what;
    return {run::Verdict::Replan, std::move(what.cause)};
  }
  // Fingers that do not move once do not move at all.
  const int most = what.cause.kind == IncidentKind::FailedActuator ? 1 : options_.retries;
  if (++tries_[what.about] <= most) return {run::Verdict::Replan, std::move(what.cause)};
  what.cause.evidence.push_back(
      fmt::format("that is the {}. time with {}, and the last", tries_[what.about], what.about));
  return {run::Verdict::GiveUp, std::move(what.cause)};
}

}  // namespace stepwright::tamp::mission
