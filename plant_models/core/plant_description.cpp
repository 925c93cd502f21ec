#include "plant_models/core/plant_description.h"

#include <nlohmann/json.hpp>

namespace stepwright::core {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TankDescription, name, label, capacity_l, overflow_percent, position,
                                   vehicle, level_truth, sensor)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PumpDescription, name, actuator, speed_truth, flow_truth)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PipeDescription, from, to, pump, at_place)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlaceDescription, name, position, half_width, switch_sensor)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VehicleDescription, name, position_truth, speed_truth, drive_left,
                                   drive_right, track_min, track_max, places)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SensorDescription, name, unit, measures, counts_at_zero, counts_per_unit)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlantDescription, name, tanks, pumps, pipes, vehicles, sensors)

std::string to_json(const PlantDescription& description) {
  return nlohmann::json(description).dump();
}

}  // namespace stepwright::core
