#pragma once

// The monitors of a plan's program (supervisor/doc/plan_to_sfc.md) as alarms. A monitor is raised once and
// stays so until another program runs: its variable of the scan is 0 before, and then the number of the scan.
//
//   definitions.push_back(alarm_of(monitor, 3));
//   engine.offer(source, time_of_monitor(program_start_ns, interval_ns, value), value, true);
//
// Pure functions.

#include <cstddef>
#include <cstdint>
#include <string>

#include "hmi_web/alarms/definition.h"

namespace stepwright::alarms {

// As the plan document tells it.
struct PlanMonitor {
  std::string action;         // "(load v1 f1 level8)"
  std::string kind;           // "precondition", "invariant", "effect", "motion"
  std::string condition;      // "level of a2 within 0.2 of 2"
  std::string scan_variable;  // "MON_SCAN[4]"
};

// Invariants and motion are of high priority, as the action still runs; the others of medium priority.
AlarmDefinition alarm_of(const PlanMonitor& monitor, std::size_t index);

// When the scan began that raised it: scans of the program are counted from 1.
std::int64_t time_of_monitor(std::int64_t program_start_ns, std::int64_t interval_ns, double scan);

}  // namespace stepwright::alarms
