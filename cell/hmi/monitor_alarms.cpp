#include "cell/hmi/monitor_alarms.h"

namespace stepwright::hmi {

namespace {

constexpr double kTrue = 1.0;  // a verdict; 2 is FALSE

}  // namespace

std::vector<alarms::AlarmDefinition> monitor_alarms(const config::CellConfig& config) {
  std::vector<alarms::AlarmDefinition> alarms;
  for (const config::MonitorConfig& each : config.monitors) {
    if (!each.alarm) continue;
    alarms::AlarmDefinition alarm;
    alarm.name = "monitor." + each.name;
    alarm.text = "Monitor " + each.name +
                 " failed: " + (each.formula.empty() ? each.formula_file.filename().string() : each.formula);
    // Steps of charts are no tags of the page.
    alarm.source = "monitor_" + each.name + ".Verdict";
    alarm.condition.kind = alarms::ConditionKind::High;
    alarm.condition.limit = kTrue;
    alarm.priority = alarms::Priority::High;
    alarm.group = "monitors";
    alarm.consequence = "the cell has left what its configuration asks for";
    alarm.response = "see what happened before; the monitor begins anew with monitor_" + each.name +
                     ".Reset, or with the next program";
    alarm.where = each.where;
    alarms.push_back(std::move(alarm));
  }
  return alarms;
}

}  // namespace stepwright::hmi
