#pragma once

// Monitors of a plan: rungs beside its chart that watch in every scan what the plan relies on, and raise an
// alarm in the scan in which it is lost.
//
//   precondition  each observed part, in the scan in which the chart refuses to start the action
//   invariant     while the action runs: what its binding holds, and every observed fact and level that
//                 neither it nor an action beside it changes
//   effect        when the action is done: every observed fact and level that it and no other changed
//   motion        while the action runs: the raw counts of the level that it moves change at least every 2 s
//                 (of sensors that must move, where at least two counts go by in that time); if not, the
//                 sensor is frozen
//   standstill    while its outputs are on: the level that it moves goes on, by half a unit in the nominal
//                 time of three, 8 s at most (internal/pace.h)
//   rate          in every scan: the counts of a sensor with `max_rate` change no faster than that; if they
//                 do, the sensor has failed (internal/rate.h)
//
// PROGRAM monitors is a ladder diagram with a section for each action, which is jumped over while the action
// does not run, behind what is watched all the time. An alarm is raised once: MON_SCAN[n] is its scan
// (counted from 1 in MON_NOW since the program began), MON_VALUE[n] what its terminal showed (filtered
// counts, or 0 and 1), MON_COUNT the number of alarms. A second chart, PROGRAM watching, changes its step
// when MON_COUNT does, so that whoever follows the program hears of it as of any step.
//
// Pure functions.
//
//   add_monitors(*translation, run, binding, tare);
//   translation->monitors[3].text     // "level of a2 within 0.2 of 2"

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/translate/translation.h"

namespace stepwright::translate {

inline constexpr const char* kMonitorProgram = "monitors";
inline constexpr const char* kWatchProgram = "watching";
inline constexpr const char* kAlarmCount = "MON_COUNT";
// "MON_SCAN[4]" and "MON_VALUE[4]" of the monitor with index 3.
std::string alarm_scan_variable(std::size_t monitor);
std::string alarm_value_variable(std::size_t monitor);

const char* to_string(MonitorKind kind);

// Adds flags of the actions to the chart, both programs, and `Translation::monitors`. The run is the one that
// was translated. Fails with T0006 if the binding has a name of the monitors.
[[nodiscard]] result::Result<void> add_monitors(Translation& translation, const model::PlannedRun& run,
                                                const Binding& binding, const Tare& tare);

}  // namespace stepwright::translate
