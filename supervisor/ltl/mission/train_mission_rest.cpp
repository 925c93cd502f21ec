// To rest, between two plans and while something holds the train.

#include <algorithm>
#include <utility>

#include "supervisor/ltl/mission/train_mission.h"

namespace stepwright::ltl {

using run::IncidentKind;
using run::Phase;
using run::Response;

namespace {

constexpr double kRestWithin_s = 60.0;  // of the scan clock

}  // namespace

std::optional<run::Cause> TrainMission::hold_stopped() {
  const run::Cause cause = stopped_by_itself();
  return hold(cause, Phase::Waiting, cause.evidence.front() + ": see to it, then let the train go on");
}

// The train stands, and the program goes on scanning. Why the next plan is made; nothing if the run has
// ended.
std::optional<run::Cause> TrainMission::hold(const run::Cause& cause, Phase phase,
                                             const std::string& message) {
  hold_.begin();
  draw();  // how far it has come, for pages that see nothing of its way now
  const bool goes_on = hold_at_rest({.cause = cause,
                                     .phase = phase,
                                     .message = message,
                                     .most = options_.hold,
                                     .stopped = "the program was stopped while the train was held",
                                     .left = cause.evidence.front() + "; nobody has let the train go on",
                                     .holds = [this] { return hold_.holds(); },
                                     .see = [this](std::span<const std::byte> image) { see(image); }});
  if (!goes_on) return std::nullopt;
  return run::Cause{IncidentKind::Operator, {"the train goes on"}};
}

void TrainMission::see(std::span<const std::byte> image) {
  reading_ = reader_->read(image);
  // A program that watches the task before knows nothing of this one.
  if (watched_ == task_.text) state_ = reading_.state;
  // In its first scan a program still shows the arc of the one before.
  if (steps_[reading_.step].kind != TrainStepKind::Start) pictures_.cover(reading_.arc_m);
}

// Along its way where it drives on one; with brakes on where it stands, or nobody knows.
bool TrainMission::bring_to_rest() {
  while (true) {
    const bool drives = reader_ && runs() && driven_ && reading_.error == 0 && !driven_->way.samples.empty();
    const std::uint32_t reset = reading_.error != 0 ? ++resets_ : 0;
    const auto prepared =
        drives ? planning_.halt(*driven_, reading_.state) : planning_.observe(task_, state_, reset);
    if (!prepared) return give_up("the train cannot be brought to rest", prepared.error());
    if (!bring_to_run([&] { return install(*prepared); })) return false;
    switch (await_train()) {
      case Rest::Reached:
        break;
      case Rest::Lost:
        driven_.reset();
        continue;
      case Rest::Error: {
        if (!options_.attended) return give_up(stopped_by_itself());
        decide(Response::Replan);
        const auto cause = hold_stopped();
        if (!cause) return false;
        open_incident(*cause);
        set_phase(Phase::Replanning, cause->evidence.front());
        continue;
      }
      case Rest::Ended:
        return false;
    }
    if (!hold_.wanted()) return true;
    decide(Response::Replan);
    (void)controller_.acknowledge(rested_at_);  // the clock goes on while the train is held
    const auto cause = hold({IncidentKind::Operator, {"held by the operator: the train rests"}}, Phase::Held,
                            "held by the operator: the train rests until it is resumed or aborted");
    if (!cause) return false;
    open_incident(*cause);
    set_phase(Phase::Replanning, cause->evidence.front());
  }
}

TrainMission::Rest TrainMission::await_train() {
  bool reset_seen = reading_.error == 0;
  return await_rest({.within_s = kRestWithin_s,
                     .late = "the train does not come to rest",
                     .stopped = "the program was stopped while the train was brought to rest",
                     .see = [&](std::span<const std::byte> image) -> std::optional<Rest> {
                       see(image);
                       reset_seen = reset_seen || reading_.error == 0;
                       const bool stopped = reading_.error != 0 || !reading_.estop_ok;
                       const bool done = steps_[reading_.step].kind == TrainStepKind::Done;
                       if (stopped && (reset_seen || done)) return Rest::Error;
                       if (!stopped && done && reading_.standing) return Rest::Reached;
                       return std::nullopt;
                     }});
}

}  // namespace stepwright::ltl
