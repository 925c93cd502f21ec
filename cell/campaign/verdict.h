#pragma once

// Verdicts of a campaign, and what its judges have in common. Plain values; pure functions; any thread.

#include <cstdint>
#include <string>

#include "cell/simulation/simulated_controller.h"
#include "supervisor/run/run_record.h"

namespace stepwright::campaign {

enum class Verdict : std::uint8_t {
  GoalReached,  // or, without a planner, run to its end
  SafeStop,     // given up for a reason that a fault can give, with the outputs in their safe state
  Lost,         // ended otherwise, or claims what is not so
  Violated,     // something happened that must not, whatever the end
};
inline constexpr std::size_t kVerdicts = 4;

const char* to_string(Verdict verdict);

// What is wrong with any end of a mission, whichever the cell: an output is on, an incident has no decision,
// it is neither done nor safe. Empty: nothing.
std::string wrong_end(const run::RunRecord& record, const simulation::SimulatedController& controller);

// What is wrong with a stop of a mission: it has no incident that stopped it, or one without evidence. Empty:
// nothing.
std::string wrong_stop(const run::RunRecord& record);

}  // namespace stepwright::campaign
