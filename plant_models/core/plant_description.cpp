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
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BeltDescription, name, actuator, speed_truth, low_x, low_y, high_x, high_y,
                                   direction_x, direction_y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BeamDescription, name, from_x, from_y, to_x, to_y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PusherDescription, name, actuator, travel_truth, home_x, home_y, length,
                                   thickness, direction_x, direction_y, stroke)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoxDescription, name, length, width, state_truth, x_truth, y_truth,
                                   angle_truth)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ForkliftDescription, name, front, rear, width, x_truth, y_truth,
                                   heading_truth, lock_truth, load_truth, wheelbase)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ObstacleDescription, name, x, y, angle, length, width, there_truth)
NLOHMANN_JSON_SERIALIZE_ENUM(RegionKind, {{RegionKind::Wall, "wall"},
                                          {RegionKind::Obstacle, "obstacle"},
                                          {RegionKind::Place, "place"},
                                          {RegionKind::Blockage, "blockage"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RegionDescription, name, kind, x, y, live)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LinkDescription, name, length, width, x_truth, y_truth, heading_truth,
                                   state_truth)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlantDescription, name, tanks, pumps, pipes, vehicles, sensors, belts,
                                   beams, pushers, boxes, forklifts, obstacles, regions, links)

std::string to_json(const PlantDescription& description) {
  return nlohmann::json(description).dump();
}

}  // namespace stepwright::core
