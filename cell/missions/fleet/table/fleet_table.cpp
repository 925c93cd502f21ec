#include "cell/missions/fleet/table/fleet_table.h"

#include <utility>

namespace stepwright::missions {
namespace {

using settings::TomlTable;

FleetAsked read_request(const TomlTable& table) {
  FleetAsked request;
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

std::shared_ptr<const MissionTable> read_fleet_table(const TomlTable& fleet, const TablePlace& place) {
  auto mission = std::make_shared<FleetTable>();
  mission->problem = required_file(fleet, "problem", place.folder);
  mission->where = fleet.where("problem");
  mission->path_factor = fleet.number("path_factor", mission->path_factor, {1.0, 100.0});
  mission->time = std::chrono::milliseconds(fleet.integer("time_ms", 0, {0, 86'400'000}));
  mission->late =
      std::chrono::milliseconds(fleet.integer("late_ms", mission->late.count(), {100, 3'600'000}));
  mission->hold = std::chrono::seconds(fleet.integer("hold_s", mission->hold.count(), {0, 31'536'000}));
  mission->attended = fleet.boolean("attended", mission->attended);
  for (const TomlTable& table : fleet.tables("requests")) mission->requests.push_back(read_request(table));
  for (const TomlTable& table : fleet.tables("orders")) {
    FleetOrder order;
    order.at_s = table.required_number("at_s", {0.0, 1e9});
    order.name = table.required_text("name");
    order.from = table.required_text("from");
    order.to = table.required_text("to");
    order.amount = static_cast<std::uint32_t>(table.integer("amount", 1, {1, 1'000'000}));
    order.where = table.where("name");
    mission->orders.push_back(std::move(order));
  }
  return mission;
}

}  // namespace stepwright::missions
