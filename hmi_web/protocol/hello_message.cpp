// The greeting with the description of the plant; see messages.h.

#include "hmi_web/protocol/floor_json.h"
#include "hmi_web/protocol/json_text.h"
#include "hmi_web/protocol/messages.h"
#include "hmi_web/protocol/tag_note_json.h"

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

json to_json(const Belt& belt) {
  return {{"id", belt.id},
          {"label", belt.label},
          {"running", belt.running_point},
          {"low", {number(belt.low_x), number(belt.low_y)}},
          {"high", {number(belt.high_x), number(belt.high_y)}},
          {"direction", {number(belt.direction_x), number(belt.direction_y)}}};
}

json to_json(const Beam& beam) {
  return {{"id", beam.id},
          {"dark", beam.dark_point},
          {"from", {number(beam.from_x), number(beam.from_y)}},
          {"to", {number(beam.to_x), number(beam.to_y)}}};
}

json to_json(const Pusher& pusher) {
  return {{"id", pusher.id},
          {"label", pusher.label},
          {"out", pusher.out_point},
          {"travel", pusher.travel_point},
          {"home", {number(pusher.home_x), number(pusher.home_y)}},
          {"size", {number(pusher.length), number(pusher.thickness)}},
          {"direction", {number(pusher.direction_x), number(pusher.direction_y)}},
          {"stroke", number(pusher.stroke)}};
}

json to_json(const Box& box) {
  return {{"id", box.id},
          {"label", box.label},
          {"size", {number(box.length), number(box.width)}},
          {"state", box.state_point},
          {"x", box.x_point},
          {"y", box.y_point},
          {"angle", box.angle_point}};
}

template <typename T>
json list(const std::vector<T>& items) {
  json result = json::array();
  for (const auto& item : items) result.push_back(to_json(item));
  return result;
}

}  // namespace

std::string hello_message(const Greeting& greeting, const Synoptic& synoptic, const std::string& epoch) {
  return text({{"type", "hello"},
               {"protocol", kProtocolVersion},
               {"epoch", epoch},
               {"cell", greeting.cell},
               {"version", greeting.server_version},
               {"recipes", greeting.recipes},
               {"drawing", greeting.drawing},
               {"tags", list(greeting.tags)},
               {"synoptic",
                {{"points", list(synoptic.points)},
                 {"places", list(synoptic.places)},
                 {"vehicles", list(synoptic.vehicles)},
                 {"tanks", list(synoptic.tanks)},
                 {"pumps", list(synoptic.pumps)},
                 {"pipes", list(synoptic.pipes)},
                 {"belts", list(synoptic.belts)},
                 {"beams", list(synoptic.beams)},
                 {"pushers", list(synoptic.pushers)},
                 {"boxes", list(synoptic.boxes)},
                 {"floor", floor_json(synoptic.floor)}}}});
}

}  // namespace stepwright::protocol
