#include "cell/runtime/host_options.h"

#include <unistd.h>

#include <cmath>

#include "runtime/record/retain_store.h"

namespace stepwright::cell_runtime {

namespace {

host::TaskSettings task_settings(const config::TaskConfig& task) {
  host::TaskSettings settings;
  settings.name = task.name;
  settings.phase_ns = task.phase_us * 1'000;
  settings.overrun = task.overrun == config::OverrunAction::Fault     ? scan::OverrunPolicy::Fault
                     : task.overrun == config::OverrunAction::CatchUp ? scan::OverrunPolicy::CatchUp
                                                                      : scan::OverrunPolicy::Skip;
  settings.cpu = task.cpu;
  return settings;
}

// What stands at [retain] file must be a store, or nothing. A file that only its runtime may read is left to
// that.
result::Result<void> check_retain(const config::RetainSection& retain) {
  if (retain.file.empty() || access(retain.file.c_str(), R_OK) != 0) return {};
  auto place = record::RetainStore::check_place(retain.file);
  if (place) return {};
  for (result::Diagnostic& each : place.error()) {
    each.message = retain.file.string() + ": " + each.message;
    if (!retain.where.file.empty()) each.where = retain.where;
  }
  return place;
}

}  // namespace

result::Result<host::HostConfig> host_options(const config::CellConfig& config) {
  if (auto place = check_retain(config.retain); !place) return result::forward(place);
  host::HostConfig options;
  options.clock =
      config.clock.mode == config::ClockMode::Real ? host::ClockMode::Real : host::ClockMode::Simulated;
  options.engine = config.engine == config::EngineKind::Native ? host::EngineKind::Native
                   : config.engine == config::EngineKind::Vm   ? host::EngineKind::Vm
                                                               : host::EngineKind::Auto;
  options.speed = config.clock.speed;
  options.idle_interval_ns = config.clock.interval_us * 1'000;
  options.input_bytes = config.image.input_bytes;
  options.output_bytes = config.image.output_bytes;
  options.safety = config.safety.host;
  options.on_lost_supervisor = config.on_lost_supervisor == config::LostSupervisorPolicy::Safe
                                   ? host::LostSupervisor::Safe
                                   : host::LostSupervisor::Continue;
  options.cpu = config.cpu;
  options.memory_limit_bytes = std::size_t{config.memory_limit_mb} << 20;
  for (const config::TaskConfig& task : config.tasks) options.tasks.push_back(task_settings(task));
  for (const config::ScheduledFault& fault : config.faults) {
    // A change of what is asked for is the supervisor's business.
    if (config::is_goal_change(fault)) continue;
    options.faults.push_back({std::llround(fault.at_s * 1e9), fault.name, fault.value});
  }
  options.change_trial_scans = config.change.trial_scans;
  options.retain = {config.retain.file, std::chrono::nanoseconds(config.retain.period).count(),
                    config.retain.policy == config::RetainPolicy::Initialise
                        ? record::RetainPolicy::Initialise
                    : config.retain.policy == config::RetainPolicy::Refuse ? record::RetainPolicy::Refuse
                                                                           : record::RetainPolicy::Carry};
  return options;
}

}  // namespace stepwright::cell_runtime
