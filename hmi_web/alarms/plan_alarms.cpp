#include "hmi_web/alarms/plan_alarms.h"

#include <cmath>

namespace stepwright::alarms {

AlarmDefinition alarm_of(const PlanMonitor& monitor, std::size_t index) {
  AlarmDefinition made;
  made.name = "plan." + std::to_string(index) + "." + monitor.kind;
  made.text = monitor.kind + " of " + monitor.action + " lost: " + monitor.condition;
  made.source = monitor.scan_variable;
  made.condition.kind = ConditionKind::On;
  const bool runs = monitor.kind == "invariant" || monitor.kind == "motion";
  made.priority = runs ? Priority::High : Priority::Medium;
  made.group = "plan";
  made.consequence = "the plan does not reach its goal as it is";
  made.response = "see what the supervisor decides; it replans, or stops in the safe state";
  return made;
}

std::int64_t time_of_monitor(std::int64_t program_start_ns, std::int64_t interval_ns, double scan) {
  if (!(scan >= 1.0)) return program_start_ns;
  return program_start_ns + (std::llrint(scan) - 1) * interval_ns;
}

}  // namespace stepwright::alarms
