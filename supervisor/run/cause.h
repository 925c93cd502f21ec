#pragma once

// The cause for which a plan cannot go on, and the decision that follows.
//
// Plain values.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/run/incident.h"

namespace stepwright::run {

struct Cause {
  IncidentKind kind = IncidentKind::Level;
  std::vector<std::string> evidence;   // sentences
  std::string action{};                // or the vehicle that it concerns
  std::vector<std::string> devices{};  // that actions needed which had no effect or did not end in time
  std::string signature{};             // the same for the same thing happening again

  // Whether any plan would be unsafe or in vain.
  bool stops() const { return kind == IncidentKind::FailedSensor || kind == IncidentKind::Leak; }
};

enum class Verdict : std::uint8_t {
  GoOn,
  Replan,       // because of the cause
  Finished,     // the plan has ended
  GiveUp,       // because of the cause
  RuntimeLost,  // it is gone, or has another program
  Hold,         // an emergency stop: the plant stands until people let it go on
};

struct Decision {
  Verdict verdict = Verdict::GoOn;
  Cause cause{};
};

inline Decision give_up_because(IncidentKind kind, std::string why) {
  return {Verdict::GiveUp, {kind, {std::move(why)}}};
}

// Several causes as one sentence: "a; b".
std::string sentence_of(const std::vector<std::string>& causes);

}  // namespace stepwright::run
