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

// A drive's own fault, or a joint that does not follow: whether it stands is seen later (judge_fault).
ArmsMission::Surprise ArmsMission::drive_fault(std::size_t arm, const std::string& who) const {
  Surprise made{{IncidentKind::FailedActuator, {fmt::format("a drive of the {} arm has tripped", who)}},
                "the way of the " + who + " arm"};
  const ArmReading& now = reading_.arms[arm];
  made.fault = Fault{arm, now.failed_joint, now.failed_at_rad, std::abs(now.failed_by_rad)};
  if (now.failed_joint == 0) return made;
  made.cause.evidence = {fmt::format("joint {} of the {} arm does not follow, it is {:.3f} rad off its path",
                                     now.failed_joint, who, made.fault->off_rad)};
  made.cause.devices = {fmt::format("{} joint {}", who, now.failed_joint)};
  return made;
}

// The joint that is farthest from where the plan that has ended has it. Where joints may be that far off
// their set points, one that is stuck near the end of its path does not stop the arm.
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
  if (what.fault) {  // judged by what is seen there (judge_fault)
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
