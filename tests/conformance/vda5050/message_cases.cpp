// Messages, sound and broken, one JSON line each with our verdict: {"topic", "text", "shape", "sound"}.
// `shape`: no fault of members, types and values; `sound`: no fault at all. For second_engine_test.py.
//
//   vda5050_message_cases SEED COUNT

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/support/fleet/split_mix.h"
#include "tests/support/vda5050/made_missions.h"
#include "tests/support/vda5050/standard_vehicle.h"
#include "tests/unit/supervisor/fleet/vda5050/sample_messages.h"

namespace {

using namespace stepwright;
using namespace stepwright::fleet::vda5050;
using nlohmann::json;
using support::SplitMix64;

struct Message {
  Topic topic = Topic::Order;
  std::string text;
};

// False if it has a fault.
bool print(const Message& message) {
  const auto wrong = check_message(message.topic, message.text, "case");
  bool shape = true;
  for (const auto& each : wrong) shape = shape && each.code == "F0904";
  const json line = {{"topic", to_string(message.topic)},
                     {"text", message.text},
                     {"shape", shape},
                     {"sound", wrong.empty()}};
  std::puts(line.dump().c_str());
  return wrong.empty();
}

// What samples leave out: members that vehicles of other makers send or take.
const char* rest_of(Topic topic) {
  switch (topic) {
    case Topic::Order:
      return R"({"zoneSetId": "z", "nodes": [{"nodeId": "n", "sequenceId": 0, "released": true, "actions": [],
          "nodeDescription": "d", "nodePosition": {"x": 1, "y": 2, "mapId": "m", "mapDescription": "d"}},
          {"nodeId": "k", "sequenceId": 2, "released": true, "actions": [{"actionType": "pick", "actionId": "a",
          "blockingType": "SOFT", "actionDescription": "d", "actionParameters": [{"key": "k", "value": [1, {}]}]}]}],
        "edges": [{"edgeId": "e", "sequenceId": 1, "released": true, "startNodeId": "n", "endNodeId": "k", "actions": [],
          "edgeDescription": "d", "maxHeight": 3, "minHeight": 1, "direction": "left", "maxRotationSpeed": 0.5,
          "orientation": 1, "orientationType": "GLOBAL", "corridor": {"leftWidth": 0.5, "rightWidth": 1,
          "corridorRefPoint": "CONTOUR"}, "trajectory": {"degree": 1, "knotVector": [0, 0, 1, 1],
          "controlPoints": [{"x": 1, "y": 2, "weight": 1}, {"x": 2, "y": 2, "weight": 0}]}}]})";
    case Topic::State:
      return R"({"zoneSetId": "z", "maps": [{"mapId": "m", "mapVersion": "1", "mapStatus": "ENABLED", "mapDescription": "d"}],
        "distanceSinceLastNode": 0.5, "agvPosition": {"mapDescription": "d", "localizationScore": 0.5, "deviationRange": 0.1},
        "loads": [{"loadId": "l", "loadType": "EPAL", "loadPosition": "forks", "weight": 300, "boundingBoxReference":
          {"x": 0, "y": 0, "z": 1, "theta": 0.5}, "loadDimensions": {"length": 1.2, "width": 0.8, "height": 1}}],
        "batteryState": {"batteryVoltage": 48, "batteryHealth": 90, "reach": 5000},
        "information": [{"infoType": "i", "infoLevel": "DEBUG", "infoDescription": "d",
          "infoReferences": [{"referenceKey": "k", "referenceValue": "v"}]}],
        "nodeStates": [{"nodeId": "n", "sequenceId": 2, "released": true, "nodeDescription": "d",
          "nodePosition": {"x": 1, "y": 2, "theta": 4, "mapId": "m"}}],
        "edgeStates": [{"edgeId": "e", "sequenceId": 1, "released": true, "edgeDescription": "d", "trajectory": {"degree": 1,
          "knotVector": [0, 0, 1, 1], "controlPoints": [{"x": 1, "y": 2}, {"x": 2, "y": 2}]}}],
        "errors": [{"errorType": "t", "errorLevel": "FATAL", "errorDescription": "d", "errorHint": "h"}]})";
    case Topic::Factsheet:
      return R"({"typeSpecification": {"seriesDescription": "d"}, "physicalParameters": {"angularSpeedMin": 0.1,
          "angularSpeedMax": 1}, "protocolLimits": {"maxStringLens": {"msgLen": 1000, "idLen": 30, "idNumericalOnly": false,
          "topicSerialLen": 9, "topicElemLen": 9, "enumLen": 9, "loadIdLen": 9}, "maxArrayLens": {"order.nodes": 20,
          "state.loads": 1, "instantActions": 3, "error.errorReferences": 2}, "timing": {"visualizationInterval": 0.5}},
        "agvGeometry": {"envelopes3d": [{"set": "s", "format": "DXF", "url": "u", "data": {}, "description": "d"}],
          "wheelDefinitions": [{"type": "CASTER", "isActiveDriven": false, "isActiveSteered": false, "position": {"x": 0, "y": 0},
          "diameter": 0.2, "width": 0.1, "centerDisplacement": 0.05, "constraints": "none"}]},
        "loadSpecification": {"loadSets": [{"setName": "S", "loadType": "EPAL", "loadPositions": ["forks"], "maxWeight": 900,
          "minLoadhandlingHeight": 0, "maxLoadhandlingTilt": 0.1, "agvSpeedLimit": 1, "agvAccelerationLimit": 0.3, "pickTime": 8,
          "dropTime": 7, "description": "d", "loadDimensions": {"length": 1.2, "width": 0.8}}]},
        "vehicleConfig": {"versions": [{"key": "software", "value": "1"}], "network": {"dnsServers": ["192.0.2.1"],
          "localIpAddress": "192.0.2.7", "ntpServers": [], "netmask": "255.255.255.0", "defaultGateway": "192.0.2.1"}}})";
    default:
      return "{}";
  }
}

std::string full_message(Topic topic) {
  json root = json::parse(sample_message(topic));
  root.merge_patch(json::parse(rest_of(topic)));
  return root.dump();
}

// Everything that a plan in execution sends, and what its vehicles say.
std::vector<Message> messages_of_a_run(std::uint64_t seed) {
  std::vector<Message> messages;
  const fleet::FleetPlan plan = support::random_plan(5, seed);
  auto orders = FleetOrders::create(plan, {});
  std::vector<support::StandardVehicle> vehicles;
  for (const auto& mission : plan.missions) vehicles.emplace_back("Stepwright", mission.vehicle);
  const auto send = [&](const Order& order) {
    messages.push_back({Topic::Order, to_json(order)});
    for (std::size_t v = 0; v < vehicles.size(); ++v) {
      if (plan.missions[v].vehicle == order.header.serial_number)
        vehicles[v].take_order(messages.back().text);
    }
  };
  for (const Order& order : orders->begin({})) send(order);
  for (int round = 0; round < 60; ++round) {
    for (auto& vehicle : vehicles) {
      if (!vehicle.drive()) continue;
      messages.push_back({Topic::State, to_json(vehicle.state({}))});
      for (const Order& order : orders->take(vehicle.state({}), {}).orders) send(order);
    }
  }
  return messages;
}

// A random place in the value, as its pointer.
json::json_pointer place_in(const json& root, SplitMix64& random) {
  const json flat = root.flatten();
  auto chosen = flat.begin();
  std::advance(chosen, static_cast<std::ptrdiff_t>(random.below(flat.size())));
  json::json_pointer pointer(chosen.key());
  while (!pointer.parent_pointer().empty() && random.below(4) == 0) pointer = pointer.parent_pointer();
  return pointer;
}

json other_value(SplitMix64& random) {
  static const std::vector<json> values = {nullptr,
                                           true,
                                           false,
                                           -1,
                                           0,
                                           1,
                                           2,
                                           3.5,
                                           -0.25,
                                           1e10,
                                           4294967295,
                                           4294967296,
                                           4.0,
                                           3.1416,
                                           -3.1415,
                                           "",
                                           "NONE",
                                           "HARD",
                                           "AUTOMATIC",
                                           "ONLINE",
                                           "GLOBAL",
                                           "PAUSED",
                                           "none",
                                           "2026-11-23T03:50:00.1Z",
                                           "2026-11-23T03:50:00+01:00",
                                           "2.1.0",
                                           "2.1",
                                           json::array(),
                                           json::object(),
                                           json::array({1, "a"}),
                                           json{{"x", 1}, {"y", 2}}};
  return values[random.below(values.size())];
}

std::string broken(const std::string& text, SplitMix64& random) {
  json root = json::parse(text);
  const auto changes = 1 + random.below(2);
  for (std::uint64_t k = 0; k < changes; ++k) {
    const json::json_pointer place = place_in(root, random);
    json& parent = root.at(place.parent_pointer());
    switch (random.below(4)) {
      case 0:
        if (parent.is_object()) {
          parent.erase(place.back());
        } else {
          parent.erase(std::stoul(place.back()));
        }
        break;
      case 1:
        if (parent.is_object()) {
          parent[place.back() + "s"] = parent[place.back()];
        } else {
          parent.push_back(parent.at(std::stoul(place.back())));
        }
        break;
      default:
        root.at(place) = other_value(random);
        break;
    }
    if (root.is_null() || root.empty()) break;
  }
  return root.dump();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  SplitMix64 random(std::strtoull(argv[1], nullptr, 10));
  const std::uint64_t count = std::strtoull(argv[2], nullptr, 10);
  std::vector<Message> sound;
  for (const Topic topic : kTopics) {
    sound.push_back({topic, sample_message(topic)});
    sound.push_back({topic, full_message(topic)});
  }
  bool all = true;
  for (const Message& message : messages_of_a_run(3)) {
    all = print(message) && all;
    if (random.below(100) == 0) sound.push_back(message);
  }
  for (const Message& message : sound) all = print(message) && all;
  for (std::uint64_t k = 0; k < count; ++k) {
    const Message& message = sound[random.below(sound.size())];
    print({message.topic, broken(message.text, random)});
  }
  return all ? 0 : 1;
}
