#include "programs/config/fleet_config.h"

#include <system_error>
#include <utility>

namespace stepwright::config {
namespace {

using settings::Range;
using settings::TomlTable;

constexpr Range kPlace{-320.0, 320.0};  // counts of centimetres in 16 bits
constexpr Range kAngle{-360.0, 360.0};
constexpr Range kLength{0.01, 640.0};

PlaceConfig read_place(const TomlTable& table) {
  PlaceConfig place;
  place.x_m = table.required_number("x_m", kPlace);
  place.y_m = table.required_number("y_m", kPlace);
  place.heading_deg = table.number("heading_deg", 0.0, kAngle);
  place.where = table.where();
  return place;
}

std::filesystem::path read_map_file(const TomlTable& plant, const std::filesystem::path& folder) {
  const std::string text = plant.text("map", "");
  if (text.empty()) return {};
  const std::filesystem::path file = folder / text;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    plant.report("map", "there is no file " + file.string(), "paths are taken from the folder of this file");
    return {};
  }
  return file;
}

FleetRequestConfig read_request(const TomlTable& table) {
  FleetRequestConfig request;
  request.at_s = table.required_number("at_s", {0.0, 1e9});
  request.request = table.required_text("request");
  request.vehicle = table.text("vehicle", "");
  request.where = table.where("request");
  const bool known = request.request == "return" || request.request == "hold" || request.request == "resume";
  if (!known && !request.request.empty())
    table.report("request", "nobody can ask for '" + request.request + "'",
                 "\"return\", \"hold\" or \"resume\"");
  if (known && (request.request == "return") == request.vehicle.empty())
    table.report("request", "a vehicle can return, and only the fleet can hold or resume",
                 "vehicle = \"truck 2\"");
  return request;
}

}  // namespace

FleetPlantConfig read_fleet_plant(const TomlTable& plant, const std::filesystem::path& folder) {
  FleetPlantConfig fleet;
  fleet.map = read_map_file(plant, folder);
  fleet.lift_s = plant.number("lift_s", fleet.lift_s, {0.1, 60.0});
  for (const TomlTable& table : plant.tables("vehicles")) fleet.vehicles.push_back(read_place(table));
  for (const TomlTable& table : plant.tables("pallets")) {
    const PlaceConfig place = read_place(table);
    fleet.pallets.push_back({place, table.number("load_kg", 600.0, {1.0, 100'000.0})});
  }
  for (const TomlTable& table : plant.tables("blockages")) {
    const PlaceConfig place = read_place(table);
    const double length_m = table.required_number("length_m", kLength);
    fleet.blockages.push_back({place, length_m, table.required_number("width_m", kLength)});
  }
  if (fleet.vehicles.empty()) {
    plant.report("kind", "a fleet without vehicles", "[[plant.vehicles]] with x_m, y_m and heading_deg");
  }
  return fleet;
}

FleetMissionConfig read_fleet_mission(const TomlTable& fleet, const std::filesystem::path& folder) {
  FleetMissionConfig mission;
  const std::string text = fleet.required_text("problem");
  mission.where = fleet.where("problem");
  std::error_code error;
  if (!text.empty()) mission.problem = folder / text;
  if (!text.empty() && !std::filesystem::is_regular_file(mission.problem, error)) {
    fleet.report("problem", "there is no file " + mission.problem.string(),
                 "paths are taken from the folder of this file");
  }
  mission.path_factor = fleet.number("path_factor", mission.path_factor, {1.0, 100.0});
  mission.time = std::chrono::milliseconds(fleet.integer("time_ms", 0, {0, 86'400'000}));
  mission.late = std::chrono::milliseconds(fleet.integer("late_ms", mission.late.count(), {100, 3'600'000}));
  mission.hold = std::chrono::seconds(fleet.integer("hold_s", mission.hold.count(), {0, 31'536'000}));
  mission.attended = fleet.boolean("attended", mission.attended);
  for (const TomlTable& table : fleet.tables("requests")) mission.requests.push_back(read_request(table));
  for (const TomlTable& table : fleet.tables("orders")) {
    FleetOrderConfig order;
    order.at_s = table.required_number("at_s", {0.0, 1e9});
    order.name = table.required_text("name");
    order.from = table.required_text("from");
    order.to = table.required_text("to");
    order.amount = static_cast<std::uint32_t>(table.integer("amount", 1, {1, 1'000'000}));
    order.where = table.where("name");
    mission.orders.push_back(std::move(order));
  }
  return mission;
}

}  // namespace stepwright::config
