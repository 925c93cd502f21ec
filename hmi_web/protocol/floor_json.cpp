#include "hmi_web/protocol/floor_json.h"

#include "hmi_web/protocol/json_text.h"

namespace stepwright::protocol {
namespace {

using nlohmann::json;

json to_json(const FloorMap& map) {
  return {{"low", {number(map.low_x_m), number(map.low_y_m)}},
          {"cell", map.cell_m},  // not rounded: a thousand cells would be elsewhere
          {"size", {map.columns, map.rows}},
          {"outlines", map.outlines}};
}

json to_json(const Forklift& forklift) {
  return {{"id", forklift.id},
          {"label", forklift.label},
          {"front", number(forklift.front_m)},
          {"rear", number(forklift.rear_m)},
          {"width", number(forklift.width_m)},
          {"wheelbase", number(forklift.wheelbase_m)},
          {"x", forklift.x_point},
          {"y", forklift.y_point},
          {"heading", forklift.heading_point},
          {"speed", forklift.speed_point},
          {"lock", forklift.lock_point},
          {"loaded", forklift.loaded_point},
          {"bumper", forklift.bumper_point},
          {"enable", forklift.enable_point},
          {"lift", forklift.lift_point},
          {"true_x", forklift.true_x_point},
          {"true_y", forklift.true_y_point},
          {"true_heading", forklift.true_heading_point},
          {"carries", forklift.carries_point}};
}

json to_json(const Pallet& pallet) {
  return {{"id", pallet.id},
          {"label", pallet.label},
          {"size", {number(pallet.length_m), number(pallet.width_m)}},
          {"state", pallet.state_point},
          {"x", pallet.x_point},
          {"y", pallet.y_point},
          {"angle", pallet.angle_point}};
}

json to_json(const Blockage& blockage) {
  return {{"id", blockage.id},
          {"label", blockage.label},
          {"at", {number(blockage.x_m), number(blockage.y_m)}},
          {"angle", number(blockage.angle_rad)},
          {"size", {number(blockage.length_m), number(blockage.width_m)}},
          {"there", blockage.there_point}};
}

template <typename T>
json rows_of(const std::vector<T>& items) {
  json result = json::array();
  for (const auto& item : items) result.push_back(to_json(item));
  return result;
}

}  // namespace

json floor_json(const Floor& floor) {
  return {{"maps", rows_of(floor.maps)},
          {"forklifts", rows_of(floor.forklifts)},
          {"pallets", rows_of(floor.pallets)},
          {"blockages", rows_of(floor.blockages)},
          {"estop_ok", floor.estop_ok_point}};
}

}  // namespace stepwright::protocol
