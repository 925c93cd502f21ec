#pragma once

// Options of a fleet's executive from a cell's configuration: used by supervisor and check alike. Any thread.

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "programs/fleet/cell_fleet.h"
#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::config {

// `terminals` are those of the problem's vehicles (fleet_terminals).
inline fleet::FleetPlanningOptions fleet_planning_options(const CellConfig& config,
                                                          fleet::FleetTerminals terminals) {
  fleet::FleetPlanningOptions options{.problem = config.fleet.problem,
                                      .terminals = std::move(terminals),
                                      .program = fleet_program_options(config),
                                      .reserve = {},
                                      .path_factor = config.fleet.path_factor,
                                      .time = config.fleet.time,
                                      .cache = fleet_table_folder()};
  options.program.news_every = std::chrono::milliseconds(500);
  return options;
}

// Opens the service with the cell's terminals; C0541 and C0542 beside what is wrong with the problem.
[[nodiscard]] inline result::Result<fleet::FleetPlanning> open_fleet_planning(const CellConfig& config) {
  const std::size_t vehicles = fleet_size(config.fleet.problem).value_or(config.plant.fleet.vehicles.size());
  auto terminals = fleet_terminals(config, vehicles);
  if (!terminals) return result::forward(terminals);
  return fleet::FleetPlanning::open(fleet_planning_options(config, *std::move(terminals)));
}

inline geometry::ConvexPolygon area_of(const BlockageConfig& blockage) {
  return geometry::footprint_at(
      {blockage.place.x_m, blockage.place.y_m, blockage.place.heading_deg * std::numbers::pi / 180.0},
      {.front_m = 0.5 * blockage.length_m,
       .rear_m = 0.5 * blockage.length_m,
       .half_width_m = 0.5 * blockage.width_m});
}

// Orders and reports of people while the cell runs, from its configuration. A place that the plant's fault
// block_K blocks is reported at once.
inline std::vector<fleet::TimedRequest> fleet_requests(const CellConfig& config) {
  std::vector<fleet::TimedRequest> requests;
  for (const FleetOrderConfig& order : config.fleet.orders)
    requests.push_back({order.at_s, fleet::OrderChange{order.name, order.from, order.to, order.amount}});
  for (const FleetRequestConfig& asked : config.fleet.requests) {
    if (asked.request == "return") requests.push_back({asked.at_s, fleet::ReturnChange{asked.vehicle}});
    if (asked.request == "hold") requests.push_back({asked.at_s, fleet::HoldChange{}});
    if (asked.request == "resume") requests.push_back({asked.at_s, fleet::ResumeChange{}});
  }
  for (const ScheduledFault& fault : config.faults) {
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

inline fleet::FleetExecutiveOptions fleet_executive_options(const CellConfig& config) {
  return {.cell = config.name,
          .max_replans = config.executive.max_replans,
          .operator_starts = config.executive.start == RunStart::Operator,
          .barrier = config.clock.mode == ClockMode::Simulated,
          .late = config.fleet.late,
          .hold = config.fleet.hold,
          .attended = config.fleet.attended,
          .journal = config.journal_path(),
          .requests = fleet_requests(config)};
}

}  // namespace stepwright::config
