// To rest, between two plans and while something holds the arms; and a look from there.

#include <algorithm>
#include <utility>

#include "supervisor/tamp/mission/arms_mission.h"

namespace stepwright::tamp::mission {

using run::IncidentKind;
using run::Phase;
using run::Response;

namespace {

// Of the scan clock.
constexpr double kRestWithin_s = 10.0;
constexpr double kLookWithin_s = 30.0;
constexpr int kLooks = 3;  // at what is not seen

}  // namespace

std::optional<run::Cause> ArmsMission::hold_stopped() {
  return hold({IncidentKind::Operator, {"the emergency stop is pressed"}}, Phase::Waiting,
              "the emergency stop is pressed: see to it, then let the arms go on");
}

// On their paths where a program drives them. One that was stopped by a cause is judged once they stand.
bool ArmsMission::bring_to_rest() {
  const bool works = reading_.stage == CellStage::Works || reading_.stage == CellStage::Begins;
  if (reader_ && runs() && kind_ == Kind::Follow && works && driven_) {
    const auto prepared = planning_.halt(*driven_);
    if (!prepared) return give_up("the arms cannot be brought to rest", prepared.error());
    if (!bring_to_run([&] { return install(*prepared, Kind::Halt); })) return false;
    const Rest rest = await([](const ArmsReading& now) { return now.stage == CellStage::Done; },
                            kRestWithin_s, "the arms do not come to rest", IncidentKind::Timeout);
    if (rest == Rest::Ended) return false;
    if (rest == Rest::Lost) driven_.reset();
  }
  return !hold_.wanted() || stay_held();
}

// Until all that has to be known is seen, or several looks have not shown it.
bool ArmsMission::look() {
  for (int tried = 1;; ++tried) {
    if (!picture()) return false;
    if (!reading_.estop_ok) {
      if (!options_.attended) return give_up("the emergency stop is pressed", IncidentKind::Operator);
      (void)controller_.acknowledge(rested_at_);
      if (!stay_stopped()) return false;
      tried = 0;
      continue;
    }
    if (observed_.wrong.empty()) return true;
    if (tried < kLooks) continue;
    if (!stay(observed_.wrong, IncidentKind::Position)) return false;
    tried = 0;
  }
}

// Programs that look differ, so that each is another one for the runtime.
bool ArmsMission::picture() {
  while (true) {
    const auto prepared = planning_.observe(++looks_);
    if (!prepared) return give_up("the cell cannot be looked at", prepared.error());
    if (!bring_to_run([&] { return install(*prepared, Kind::Look); })) return false;
    show_look(&prepared->program);
    const Rest rest = await([](const ArmsReading& now) { return now.stage == CellStage::Done; },
                            kLookWithin_s, "the camera does not report", IncidentKind::FailedSensor);
    if (rest == Rest::Ended) return false;
    if (rest == Rest::Reached) break;
  }
  return true;
}

ArmsMission::Rest ArmsMission::await(bool (*there)(const ArmsReading&), double within_s,
                                     const std::string& late, IncidentKind kind) {
  return await_rest({.within_s = within_s,
                     .late = late,
                     .late_kind = kind,
                     .stopped = "the program was stopped while the arms were brought to rest",
                     .see = [&](std::span<const std::byte> image) -> std::optional<Rest> {
                       see(image);
                       if (!there(reading_)) return std::nullopt;
                       if (kind_ == Kind::Look) {
                         sight_ = agree(planning_.cell(), reader_->all(image), believed_);
                         observed_ = observe(planning_.cell(), reading_, sight_, held_);
                       }
                       return Rest::Reached;
                     }});
}

}  // namespace stepwright::tamp::mission
