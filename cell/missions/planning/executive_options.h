#pragma once

// Options of planning and executive from a cell's configuration: used by supervisor, check and tests alike.
// Pure; any thread. All require that the cell has [planning].

#include "cell/config/cell_config.h"
#include "cell/missions/planning/table/planning_table.h"
#include "supervisor/executive/executive.h"
#include "supervisor/executive/planning_service.h"

namespace stepwright::missions {

inline const PlanningTable& planning_table(const config::CellConfig& config) {
  return *table_as<PlanningTable>(config.mission.table);
}

inline executive::PlanningOptions planning_options(const config::CellConfig& config) {
  const PlanningTable& table = planning_table(config);
  return {.domain = table.domain,
          .problem = table.problem,
          .binding = table.binding,
          .programs = table.programs,
          .optimal = table.optimal,
          .sequential = table.sequential,
          .time = table.time,
          .interval_us = config.clock.interval_us,
          .document = !config.controller.remote(),
          .monitors = table.monitors,
          .report_fluent = config.executive.report_fluent,
          .dialect = table.written_in};
}

inline executive::ExecutiveOptions executive_options(const config::CellConfig& config) {
  executive::ExecutiveOptions options;
  options.cell = config.name;
  options.max_replans = config.executive.max_replans;
  options.settle = config.executive.settle;
  options.believes_sensors = planning_table(config).initial == InitialState::Observed;
  options.operator_starts = config.executive.start == config::RunStart::Operator;
  options.barrier = config.clock.mode == config::ClockMode::Simulated;
  options.journal = config.journal_path();
  for (const config::ScheduledFault& fault : config.faults) {
    if (config::is_goal_change(fault)) options.goal_changes.push_back({fault.at_s, fault.name, fault.value});
  }
  options.what_if = {.time = config.executive.what_if, .memory_mb = config.executive.what_if_mb};
  return options;
}

}  // namespace stepwright::missions
