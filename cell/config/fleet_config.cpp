#include "cell/config/fleet_config.h"

namespace stepwright::config {

using settings::TomlTable;

FleetPlantConfig read_fleet_plant(const TomlTable& plant, const std::filesystem::path& folder) {
  FleetPlantConfig fleet;
  fleet.map = read_plant_file(plant, "map", folder);
  fleet.lift_s = plant.number("lift_s", fleet.lift_s, {0.1, 60.0});
  for (const TomlTable& table : plant.tables("vehicles")) fleet.vehicles.push_back(read_place(table));
  for (const TomlTable& table : plant.tables("pallets")) {
    const PlaceConfig place = read_place(table);
    fleet.pallets.push_back({place, table.number("load_kg", 600.0, {1.0, 100'000.0})});
  }
  for (const TomlTable& table : plant.tables("blockages")) fleet.blockages.push_back(read_blockage(table));
  if (fleet.vehicles.empty()) {
    plant.report("kind", "a fleet without vehicles", "[[plant.vehicles]] with x_m, y_m and heading_deg");
  }
  return fleet;
}

}  // namespace stepwright::config
