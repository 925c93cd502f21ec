#include "cell/hmi/alarm_list.h"

#include <iterator>

#include "cell/hmi/monitor_alarms.h"
#include "hmi_web/alarms/definition_file.h"
#include "hmi_web/recorder/cell_alarms.h"

namespace stepwright::hmi {
namespace {

// Alarms of the first ones; the panel of the monitors shows them all.
constexpr std::uint32_t kMostPlanMonitors = 128;

}  // namespace

result::Result<std::vector<alarms::AlarmDefinition>> alarms_of(const config::CellConfig& config,
                                                               const protocol::Synoptic& synoptic) {
  recorder::BuiltInAlarms wanted;
  wanted.supervisor = config.mission.table != nullptr;
  wanted.monitors = wanted.supervisor && config.mission.table->has_monitors() ? kMostPlanMonitors : 0;
  std::vector<alarms::AlarmDefinition> all = recorder::built_in_alarms(synoptic, wanted);
  for (alarms::AlarmDefinition& each : monitor_alarms(config)) all.push_back(std::move(each));
  if (config.history.alarms.empty()) return all;
  auto more = alarms::load_alarms(config.history.alarms);
  if (!more) return result::forward(more);
  all.insert(all.end(), std::make_move_iterator(more->begin()), std::make_move_iterator(more->end()));
  return all;
}

}  // namespace stepwright::hmi
