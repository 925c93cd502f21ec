#pragma once

// Options of planning and executive from a cell's configuration: used by supervisor, demo and check alike.
// Pure; any thread.

#include "programs/config/cell_config.h"
#include "supervisor/executive/executive.h"
#include "supervisor/executive/planning_service.h"
#include "supervisor/executive/what_if.h"

namespace stepwright::config {

inline executive::PlanningOptions planning_options(const CellConfig& config) {
  return {.domain = config.planning.domain,
          .problem = config.planning.problem,
          .binding = config.planning.binding,
          .programs = config.planning.programs,
          .optimal = config.planning.optimal,
          .sequential = config.planning.sequential,
          .time = config.planning.time,
          .interval_us = config.clock.interval_us,
          .document = !config.controller.remote(),
          .monitors = config.planning.monitors,
          .report_fluent = config.executive.report_fluent,
          .dialect = config.planning.dialect};
}

inline executive::WhatIfOptions what_if_options(const CellConfig& config) {
  return {.time = config.executive.what_if, .memory_mb = config.executive.what_if_mb};
}

inline executive::ExecutiveOptions executive_options(const CellConfig& config) {
  executive::ExecutiveOptions options;
  options.cell = config.name;
  options.max_replans = config.executive.max_replans;
  options.settle = config.executive.settle;
  options.believes_sensors = config.planning.initial == InitialState::Observed;
  options.operator_starts = config.executive.start == RunStart::Operator;
  options.barrier = config.clock.mode == ClockMode::Simulated;
  options.journal = config.journal_path();
  for (const ScheduledFault& fault : config.faults) {
    if (is_goal_change(fault)) options.goal_changes.push_back({fault.at_s, fault.name, fault.value});
  }
  return options;
}

}  // namespace stepwright::config
