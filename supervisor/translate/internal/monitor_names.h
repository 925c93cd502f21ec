#pragma once

// Names of the variables of PROGRAM monitors, and of the flags by which the chart tells it of its actions.
// Actions are numbered as in the plan, from 0.
//
// Pure functions.

#include <cstddef>
#include <string>

#include "supervisor/translate/binding.h"

namespace stepwright::translate::internal {

// Scans since the program began.
inline constexpr const char* kNow = "MON_NOW";

// "AFTER_03"
std::string numbered(const char* name, std::size_t number);

// Flags of an action, from the chart: it or its rest runs; it has failed. And both as they were a scan ago.
std::string run_flag(std::size_t action);
std::string fail_flag(std::size_t action);
std::string ran_flag(std::size_t action);
std::string had_failed_flag(std::size_t action);

// Scans for which the counts of a sensor have not changed, and what they were a scan ago.
std::string still_variable(const Sensor& sensor);
std::string last_variable(const Sensor& sensor);

// Counts at which the level that an action moves was found to have gone on, and the scans since then.
std::string mark_variable(std::size_t action);
std::string since_variable(std::size_t action);

}  // namespace stepwright::translate::internal
