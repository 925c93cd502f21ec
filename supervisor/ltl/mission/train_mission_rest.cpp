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

// How far it has come, for pages that see nothing of its way now.
void TrainMission::held() {
  draw();
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
        if (!stay_stopped()) return false;
        continue;
      }
      case Rest::Ended:
        return false;
    }
    if (!hold_.wanted()) return true;
    if (!stay_held()) return false;
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
