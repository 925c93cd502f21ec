// At rest for as long as an operator wants it. The program that reads the sensors keeps the outputs of the
// plan off; the clock goes on.

#include <fmt/format.h>

#include "supervisor/executive/executive.h"

namespace stepwright::executive {

run::Cause Executive::held_by_operator() {
  return {run::IncidentKind::Operator, {"held by the operator"}, {}};
}

std::optional<run::Cause> Executive::wish() {
  return hold_ ? std::optional(held_by_operator()) : std::nullopt;
}

// False if the run is over. A runtime that is gone, or stopped, changes nothing here: whoever resumes has the
// plant looked at anew.
bool Executive::stay_held() {
  (void)controller_.acknowledge(rested_at_);
  const auto asked = [this](const run::Cause& cause) {
    std::vector<std::string>& evidence = record_.incidents.back().evidence;
    evidence.insert(evidence.end(), cause.evidence.begin(), cause.evidence.end());
    set_phase(
        run::Phase::Held,
        cause.evidence.back() + ": that is planned for when the run is resumed; until then the plant rests");
  };
  const auto held_s =
      hold_at_rest({.message = "held by the operator: the plant rests until the run is resumed or aborted",
                    .holds = [this] { return hold_.load(); },
                    .asked = asked});
  if (!held_s) return false;
  record_.incidents.back().evidence.push_back(fmt::format("resumed after {:.1f} s", *held_s));
  set_phase(run::Phase::Replanning, "resumed by the operator");
  return true;
}

}  // namespace stepwright::executive
