#pragma once

// The part of [plant] that a floor with forklifts needs:
//
//   [plant]
//   kind = "fleet"
//   map = "map.yaml"          # of ROS; what is not free is a wall. Without it the floor is empty
//   lift_s = 2.0              # of the forks, up or down
//   [[plant.vehicles]]        # v1, v2, ...
//   x_m = 12.0
//   y_m = 5.0
//   heading_deg = 90.0
//   [[plant.pallets]]         # p1, p2, ...; heading_deg: of its long side
//   x_m = 20.0
//   y_m = 5.0
//   load_kg = 600.0
//   [[plant.blockages]]       # stand in the way while the fault block_1, block_2, ... holds
//   x_m = 30.0
//   y_m = 5.0
//   length_m = 2.0            # along heading_deg
//   width_m = 1.0
//
// Thread-safe: pure.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/result/diagnostic.h"
#include "runtime/settings/toml_document.h"

namespace stepwright::config {

struct PlaceConfig {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_deg = 0.0;
  result::Location where;
};

struct PalletConfig {
  PlaceConfig place;
  double load_kg = 600.0;
};

struct BlockageConfig {
  PlaceConfig place;
  double length_m = 1.0;
  double width_m = 1.0;
};

struct FleetPlantConfig {
  std::filesystem::path map;  // empty: no walls
  double lift_s = 2.0;
  std::vector<PlaceConfig> vehicles;
  std::vector<PalletConfig> pallets;
  std::vector<BlockageConfig> blockages;
};

// Errors are reported to the document of `plant`. Relative paths are taken from `folder`.
FleetPlantConfig read_fleet_plant(const settings::TomlTable& plant, const std::filesystem::path& folder);

// A load that somebody orders while the fleet runs.
struct FleetOrderConfig {
  double at_s = 0.0;
  std::string name;
  std::string from;
  std::string to;
  std::uint32_t amount = 1;
  result::Location where;
};

// Request of an operator at a time: "return" of a vehicle that was lost, "hold" of all, "resume" after that
// or after an emergency stop.
struct FleetRequestConfig {
  double at_s = 0.0;
  std::string request;
  std::string vehicle;  // of "return"
  result::Location where;
};

// [fleet]: what the supervisor has the fleet do.
//
//   [fleet]
//   problem = "warehouse.json"   # supervisor/doc/fleet_problems.md
//   path_factor = 1.5            # paths are proved to cost at most so many times the least
//   time_ms = 0                  # budget of a planning; 0: none, so that plans are the same on every machine
//   late_ms = 3000               # who is later than scheduled by more gives all others new times
//   hold_s = 3600                # so long an emergency stop holds the fleet until somebody lets it go on
//   attended = true              # somebody can see to what the fleet cannot do; false: then the run ends
//   [[fleet.orders]]             # somebody orders this at that time
//   at_s = 60.0
//   name = "order 43"
//   from = "rack A"
//   to = "outbound"
//   amount = 1
//   [[fleet.requests]]           # an operator asks for this at that time
//   at_s = 90.0
//   request = "return"           # or "hold", "resume", without a vehicle
//   vehicle = "truck 2"
struct FleetMissionConfig {
  std::filesystem::path problem;  // empty: the supervisor has no fleet
  double path_factor = 1.5;
  std::chrono::milliseconds time{0};
  std::chrono::milliseconds late{3'000};
  std::chrono::seconds hold{3'600};
  bool attended = true;
  std::vector<FleetOrderConfig> orders;
  std::vector<FleetRequestConfig> requests;
  result::Location where;  // of `problem`
};

// A file that is not there is reported to the document of `fleet`.
FleetMissionConfig read_fleet_mission(const settings::TomlTable& fleet, const std::filesystem::path& folder);

}  // namespace stepwright::config
