#pragma once

// Options of a fleet's executive from a cell's configuration: used by supervisor and check alike. Any thread.
// All require that the cell has [fleet].

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "cell/fleet/cell_fleet.h"
#include "cell/missions/fleet/table/fleet_table.h"
#include "cell/monitors/cell_monitors.h"
#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::missions {

inline const FleetTable& fleet_table(const config::CellConfig& config) {
  return *table_as<FleetTable>(config.mission.table);
}

// `terminals` are those of the problem's vehicles (fleet_terminals).
inline fleet::FleetPlanningOptions fleet_planning_options(const config::CellConfig& config,
                                                          fleet::FleetTerminals terminals) {
  const FleetTable& table = fleet_table(config);
  fleet::FleetPlanningOptions options{.problem = table.problem,
                                      .terminals = std::move(terminals),
                                      .program = config::fleet_program_options(config),
                                      .reserve = {},
                                      .path_factor = table.path_factor,
                                      .time = table.time,
                                      .cache = config::fleet_table_folder()};
  options.program.news_every = std::chrono::milliseconds(500);
  return options;
}

// Opens the service with the cell's terminals; C0541 and C0542 beside what is wrong with the problem.
[[nodiscard]] inline result::Result<fleet::FleetPlanning> open_fleet_planning(
    const config::CellConfig& config) {
  const std::size_t vehicles =
      config::fleet_size(fleet_table(config).problem).value_or(config.plant.fleet.vehicles.size());
  auto terminals = config::fleet_terminals(config, vehicles);
  if (!terminals) return result::forward(terminals);
  const auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) return tl::unexpected(monitors.error());
  fleet::FleetPlanningOptions options = fleet_planning_options(config, *std::move(terminals));
  options.watchers = cell_monitors::watchers_of(*monitors);
  return fleet::FleetPlanning::open(options);
}

inline geometry::ConvexPolygon area_of(const config::BlockageConfig& blockage) {
  return geometry::footprint_at(
      {blockage.place.x_m, blockage.place.y_m, blockage.place.heading_deg * std::numbers::pi / 180.0},
      {.front_m = 0.5 * blockage.length_m,
       .rear_m = 0.5 * blockage.length_m,
       .half_width_m = 0.5 * blockage.width_m});
}

// Orders and reports of people while the cell runs, from its configuration. A place that the plant's fault
// block_K blocks is reported at once.
inline std::vector<fleet::TimedRequest> fleet_requests(const config::CellConfig& config) {
  std::vector<fleet::TimedRequest> requests;
  for (const FleetOrder& order : fleet_table(config).orders)
    requests.push_back({order.at_s, fleet::OrderChange{order.name, order.from, order.to, order.amount}});
  for (const FleetAsked& asked : fleet_table(config).requests) {
    if (asked.request == "return") requests.push_back({asked.at_s, fleet::ReturnChange{asked.vehicle}});
    if (asked.request == "hold") requests.push_back({asked.at_s, fleet::HoldChange{}});
    if (asked.request == "resume") requests.push_back({asked.at_s, fleet::ResumeChange{}});
  }
  for (const config::ScheduledFault& fault : config.faults) {
    for (std::size_t k = 0; k < config.plant.fleet.blockages.size(); ++k) {
      const std::string name = "block_" + std::to_string(k + 1);
      if (fault.name != name) continue;
      if (fault.value != 0.0) {
        requests.push_back(
            {fault.at_s, fleet::BlockChange{{name, area_of(config.plant.fleet.blockages[k])}}});
      } else {
        requests.push_back({fault.at_s, fleet::UnblockChange{name}});
      }
    }
  }
  std::ranges::stable_sort(requests, {}, &fleet::TimedRequest::at_s);
  return requests;
}

inline fleet::FleetExecutiveOptions fleet_executive_options(const config::CellConfig& config) {
  return {.cell = config.name,
          .max_replans = config.executive.max_replans,
          .operator_starts = config.executive.start == config::RunStart::Operator,
          .barrier = config.clock.mode == config::ClockMode::Simulated,
          .late = fleet_table(config).late,
          .hold = fleet_table(config).hold,
          .attended = fleet_table(config).attended,
          .journal = config.journal_path(),
          .requests = fleet_requests(config)};
}

}  // namespace stepwright::missions
