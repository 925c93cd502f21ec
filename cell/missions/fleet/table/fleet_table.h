#pragma once

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

#include <chrono>
#include <cstdint>
#include <span>

#include "cell/missions/table/mission_table.h"
#include "runtime/ground/settings/key_words.h"

namespace stepwright::missions {

// A load that somebody orders while the fleet runs.
struct FleetOrder {
  double at_s = 0.0;
  std::string name;
  std::string from;
  std::string to;
  std::uint32_t amount = 1;
  result::Location where;
};

// What an operator asks for at that time: "return" of a vehicle that was lost, "hold" of all, "resume" after
// that or after an emergency stop.
struct FleetAsked {
  double at_s = 0.0;
  std::string request;
  std::string vehicle;  // of "return"
  result::Location where;
};

struct FleetTable final : MissionTable {
  std::filesystem::path problem;
  double path_factor = 1.5;
  std::chrono::milliseconds time{0};
  std::chrono::milliseconds late{3'000};
  std::chrono::seconds hold{3'600};
  bool attended = true;
  std::vector<FleetOrder> orders;
  std::vector<FleetAsked> requests;
  result::Location where;  // of `problem`

  std::vector<std::string> unattended() const override { return {"fleet.attended=false"}; }
};

std::shared_ptr<const MissionTable> read_fleet_table(const settings::TomlTable& table,
                                                     const TablePlace& place);

// What people are told of its keys.
std::span<const settings::KeyWords> fleet_keys();

}  // namespace stepwright::missions
