#pragma once

// Alarms of the page for the cell's monitors: one for each whose `on_false` says so, on its tag
// monitor_NAME.Verdict, with the formula in its text.
//
// Pure; any thread.

#include <vector>

#include "cell/config/cell_config.h"
#include "hmi_web/alarms/definition.h"

namespace stepwright::hmi {

// Named "monitor.NAME", of high priority.
std::vector<alarms::AlarmDefinition> monitor_alarms(const config::CellConfig& config);

}  // namespace stepwright::hmi
