#pragma once

// The statements around the charts: terminals into vehicles and back, and the function blocks between. Pure.
// Detail of this folder.

#include <string>
#include <utility>
#include <vector>

#include "ladder/graphic/project.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/fleet/program/time_rules.h"

namespace stepwright::fleet {

// Names of a vehicle and its tables in the program; `path` empty: it has no path.
struct VehicleNames {
  std::string name;
  std::string path;
  std::string areas;
  std::string planes;
  std::size_t turn = 0;  // its number
};

std::vector<graphic::Variable> shared_globals(const FleetTerminals& terminals);
// Of what temporal constraints ask for.
std::vector<graphic::Variable> time_globals(const FleetPlan& plan, const TimeRules& rules);
std::vector<graphic::Variable> vehicle_globals(const VehicleMission& mission, const VehicleNames& names,
                                               const VehicleTerminals& terminals,
                                               const ProgramOptions& options);

// PROGRAM sensing: before the charts. Blocks: the instances that the text calls.
std::string sensing_text(const FleetPlan& plan, const std::vector<VehicleNames>& vehicles,
                         const TimeRules& rules, std::uint32_t revision);
std::vector<graphic::Variable> sensing_blocks(const std::vector<VehicleNames>& vehicles,
                                              const TimeRules& rules, std::uint32_t revision);
// PROGRAM driving: behind them.
std::string driving_text(const std::vector<VehicleNames>& vehicles, const ProgramOptions& options);
std::vector<graphic::Variable> driving_blocks(const std::vector<VehicleNames>& vehicles,
                                              const ProgramOptions& options);

// "set_speed" -> its address, and so on; all of them.
std::vector<std::pair<std::string, std::string>> named_terminals(const VehicleTerminals& terminals);

}  // namespace stepwright::fleet
