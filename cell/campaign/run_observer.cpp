#include "cell/campaign/run_observer.h"

#include "cell/monitor_check/monitor_names.h"
#include "hmi_web/alarms/definition_file.h"
#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::campaign {

RunObserver::RunObserver(const config::CellConfig& config) {
  for (const config::MonitorConfig& each : config.monitors)
    monitors_.push_back({each.name, cell_monitors::failed_tag(each.name)});
  if (config.history.alarms.empty()) return;
  const auto definitions = alarms::load_alarms(config.history.alarms);
  if (!definitions) return;
  for (const alarms::AlarmDefinition& each : *definitions)
    watched_alarms_.push_back({each.name, each.source, alarms::Condition(each.condition)});
}

void RunObserver::find_places(const simulation::SimulatedController& controller) {
  program_ = controller.programs_loaded();
  const reader::ProgramInfo* const program = controller.program_info();
  for (Monitor& each : monitors_) each.place = program == nullptr ? nullptr : program->find(each.tag);
  for (Alarm& each : watched_alarms_) each.place = program == nullptr ? nullptr : program->find(each.source);
}

void RunObserver::look(const simulation::SimulatedController& controller, std::span<const std::byte> image) {
  if (controller.programs_loaded() != program_) find_places(controller);
  for (Monitor& each : monitors_) {
    if (each.told || each.place == nullptr || reader::read_number(*each.place, image) == 0.0) continue;
    each.told = true;
    failed_.push_back({each.name, controller.now_s()});
  }
  const std::int64_t now_ns = controller.plant().now().count();
  for (Alarm& each : watched_alarms_) {
    if (each.place == nullptr) continue;
    auto change = each.condition.expire(now_ns);
    if (auto offered = each.condition.offer(now_ns, reader::read_quantity(*each.place, image), true))
      change = offered;
    if (change && change->active) alarms_.push_back({each.name, controller.now_s()});
  }
}

}  // namespace stepwright::campaign
