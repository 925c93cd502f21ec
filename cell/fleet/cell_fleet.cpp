#include "cell/fleet/cell_fleet.h"

#include <cstdlib>
#include <string>

#include "cell/config/port_reader.h"
#include "runtime/ground/files/files.h"
#include "supervisor/fleet/mission/problem_reader.h"

namespace stepwright::config {

result::Result<fleet::FleetTerminals> fleet_terminals(const CellConfig& cell, std::size_t vehicles) {
  if (cell.plant.kind == "fleet" && cell.plant.fleet.vehicles.size() != vehicles) {
    return result::fail("C0542", {cell.file.string(), 0, 0},
                        "the plant has " + std::to_string(cell.plant.fleet.vehicles.size()) +
                            " vehicles, the problem " + std::to_string(vehicles),
                        "v1, v2, ... are the problem's vehicles in their order");
  }
  if (cell.plant.ports.empty()) return fleet::terminals_in_a_row(vehicles);
  PortReader ports(cell);
  fleet::FleetTerminals all;
  for (std::size_t k = 1; k <= vehicles; ++k) {
    const auto of = [&](const char* what) { return ports.address(what + ("_v" + std::to_string(k))); };
    all.vehicles.push_back({.x = of("x"),
                            .y = of("y"),
                            .heading = of("heading"),
                            .speed = of("speed"),
                            .lock = of("lock"),
                            .lifted = of("lifted"),
                            .lowered = of("lowered"),
                            .loaded = of("loaded"),
                            .bumper = of("bumper"),
                            .set_speed = of("set_speed"),
                            .set_lock = of("set_lock"),
                            .enable = of("enable"),
                            .lift = of("lift")});
  }
  all.estop_ok = ports.address("estop_ok");
  if (auto wrong = ports.take(); !wrong.empty()) return tl::unexpected(std::move(wrong));
  return all;
}

std::optional<std::size_t> fleet_size(const std::filesystem::path& problem) {
  const auto text = files::read_file(problem.string());
  if (!text) return std::nullopt;
  const auto read = fleet::read_mission_problem(*text, problem);
  return read ? std::optional(read->vehicles.size()) : std::nullopt;
}

std::filesystem::path fleet_table_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return std::filesystem::path(cache) / "stepwright";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".cache" / "stepwright";
  }
  return {};
}

fleet::ProgramOptions fleet_program_options(const CellConfig& cell) {
  fleet::ProgramOptions options;
  options.interval_us = cell.clock.interval_us;
  // Where no pallets stand on the floor the switches under the forks never close.
  options.load_switches = cell.plant.kind != "fleet" || !cell.plant.fleet.pallets.empty();
  return options;
}

}  // namespace stepwright::config
