#include "cell/config/fleet_config.h"

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

}  // namespace stepwright::config
