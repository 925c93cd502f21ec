// The greeting with the description of the plant; see messages.h.

#include "hmi_web/protocol/json_text.h"
#include "hmi_web/protocol/messages.h"

namespace stepwright::protocol {
namespace {

using nlohmann::json;

const char* to_string(TankSide side) {
  switch (side) {
    case TankSide::Above:
      return "above";
    case TankSide::Below:
      return "below";
    case TankSide::OnVehicle:
      return "vehicle";
  }
  return "below";
}

json to_json(const Point& point) {
  return {{"id", point.id}, {"label", point.label}, {"unit", point.unit}, {"trend", point.trend}};
}

json to_json(const Place& place) {
  return {{"id", place.id},
          {"label", place.label},
          {"position", number(place.position)},
          {"switch", place.switch_point}};
}

json to_json(const Vehicle& vehicle) {
  return {{"id", vehicle.id},
          {"label", vehicle.label},
          {"position", vehicle.position_point},
          {"left", vehicle.left_point},
          {"right", vehicle.right_point}};
}

json to_json(const Tank& tank) {
  return {{"id", tank.id},
          {"label", tank.label},
          {"side", to_string(tank.side)},
          {"at", tank.at},
          {"level", tank.level_point},
          {"truth", tank.truth_point},
          {"low_percent", number(tank.low_percent)},
          {"high_percent", number(tank.high_percent)}};
}

json to_json(const Pump& pump) {
  return {{"id", pump.id}, {"label", pump.label}, {"running", pump.running_point}, {"flow", pump.flow_point}};
}

json to_json(const Pipe& pipe) {
  return {{"from", pipe.from}, {"to", pipe.to}, {"pump", pipe.pump}, {"at_place", pipe.at_place}};
}

template <typename T>
json list(const std::vector<T>& items) {
  json result = json::array();
  for (const auto& item : items) result.push_back(to_json(item));
  return result;
}

}  // namespace

std::string hello_message(const Greeting& greeting, const Synoptic& synoptic) {
  return text({{"type", "hello"},
               {"protocol", kProtocolVersion},
               {"cell", greeting.cell},
               {"version", greeting.server_version},
               {"synoptic",
                {{"points", list(synoptic.points)},
                 {"places", list(synoptic.places)},
                 {"vehicles", list(synoptic.vehicles)},
                 {"tanks", list(synoptic.tanks)},
                 {"pumps", list(synoptic.pumps)},
                 {"pipes", list(synoptic.pipes)}}}});
}

}  // namespace stepwright::protocol
