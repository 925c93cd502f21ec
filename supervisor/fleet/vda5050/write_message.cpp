#include "supervisor/fleet/vda5050/write_message.h"

#include <nlohmann/json.hpp>

#include "supervisor/fleet/vda5050/internal/words.h"

namespace stepwright::fleet::vda5050 {

namespace {

// Members in the order of the standard: people read logs.
using json = nlohmann::ordered_json;

json header_json(const Header& header) {
  return {{"headerId", header.header_id},
          {"timestamp", to_text(header.timestamp)},
          {"version", header.version},
          {"manufacturer", header.manufacturer},
          {"serialNumber", header.serial_number}};
}

std::string text(const json& root) {
  return root.dump(-1, ' ', false, json::error_handler_t::replace);
}

template <typename Value>
void set(json& object, const char* name, const std::optional<Value>& value) {
  if (value) object[name] = *value;
}

void set(json& object, const char* name, const std::string& value) {
  if (!value.empty()) object[name] = value;
}

template <typename Items, typename Convert>
json list_of(const Items& items, Convert convert) {
  json list = json::array();
  for (const auto& item : items) list.push_back(convert(item));
  return list;
}

json action_json(const Action& action) {
  json object = {{"actionType", action.type},
                 {"actionId", action.id},
                 {"blockingType", word_of(kBlockings, action.blocking)}};
  if (action.parameters.empty()) return object;
  json& parameters = object["actionParameters"] = json::array();
  for (const auto& [key, value] : action.parameters) {
    json parameter = {{"key", key}};
    std::visit([&](const auto& held) { parameter["value"] = held; }, value);
    parameters.push_back(std::move(parameter));
  }
  return object;
}

json position_json(const NodePosition& position) {
  json object = {{"x", position.x_m}, {"y", position.y_m}};
  set(object, "theta", position.theta_rad);
  set(object, "allowedDeviationXY", position.deviation_xy_m);
  set(object, "allowedDeviationTheta", position.deviation_theta_rad);
  object["mapId"] = position.map_id;
  return object;
}

json node_json(const Node& node) {
  json object = {{"nodeId", node.id}, {"sequenceId", node.sequence}};
  set(object, "nodeDescription", node.description);
  object["released"] = node.released;
  if (node.position) object["nodePosition"] = position_json(*node.position);
  object["actions"] = list_of(node.actions, action_json);
  return object;
}

json edge_json(const Edge& edge) {
  json object = {{"edgeId", edge.id},
                 {"sequenceId", edge.sequence},
                 {"released", edge.released},
                 {"startNodeId", edge.start_node},
                 {"endNodeId", edge.end_node}};
  set(object, "maxSpeed", edge.max_speed_mps);
  if (edge.orientation_rad) {
    object["orientation"] = *edge.orientation_rad;
    object["orientationType"] = "TANGENTIAL";
  }
  set(object, "rotationAllowed", edge.rotation_allowed);
  set(object, "length", edge.length_m);
  if (edge.trajectory) {
    object["trajectory"] = {{"degree", edge.trajectory->degree},
                            {"knotVector", edge.trajectory->knots},
                            {"controlPoints", list_of(edge.trajectory->points, [](const ControlPoint& p) {
                               return json{{"x", p.x_m}, {"y", p.y_m}};
                             })}};
  }
  object["actions"] = list_of(edge.actions, action_json);
  return object;
}

json agv_position_json(const AgvPosition& position) {
  return {{"x", position.x_m},
          {"y", position.y_m},
          {"theta", position.theta_rad},
          {"mapId", position.map_id},
          {"positionInitialized", position.initialized}};
}

json velocity_json(const Velocity& velocity) {
  return {{"vx", velocity.vx_mps}, {"vy", velocity.vy_mps}, {"omega", velocity.omega_radps}};
}

json action_state_json(const ActionState& action) {
  json object = {{"actionId", action.id}};
  set(object, "actionType", action.type);
  object["actionStatus"] = word_of(kStatuses, action.status);
  set(object, "resultDescription", action.result);
  return object;
}

json error_json(const VehicleError& error) {
  json object = {{"errorType", error.type}};
  if (!error.references.empty()) {
    object["errorReferences"] = list_of(error.references, [](const auto& reference) {
      return json{{"referenceKey", reference.first}, {"referenceValue", reference.second}};
    });
  }
  set(object, "errorDescription", error.description);
  object["errorLevel"] = word_of(kErrorLevels, error.level);
  return object;
}

}  // namespace

std::string to_json(const Order& order) {
  json root = header_json(order.header);
  root["orderId"] = order.order_id;
  root["orderUpdateId"] = order.update_id;
  root["nodes"] = list_of(order.nodes, node_json);
  root["edges"] = list_of(order.edges, edge_json);
  return text(root);
}

std::string to_json(const InstantActions& actions) {
  json root = header_json(actions.header);
  root["actions"] = list_of(actions.actions, action_json);
  return text(root);
}

std::string to_json(const State& state) {
  json root = header_json(state.header);
  root["orderId"] = state.order_id;
  root["orderUpdateId"] = state.update_id;
  root["lastNodeId"] = state.last_node;
  root["lastNodeSequenceId"] = state.last_node_sequence;
  root["driving"] = state.driving;
  root["paused"] = state.paused;
  root["newBaseRequest"] = state.new_base_request;
  root["operatingMode"] = word_of(kModes, state.mode);
  root["nodeStates"] = list_of(state.nodes, [](const NodeState& node) {
    return json{{"nodeId", node.id}, {"sequenceId", node.sequence}, {"released", node.released}};
  });
  root["edgeStates"] = list_of(state.edges, [](const EdgeState& edge) {
    return json{{"edgeId", edge.id}, {"sequenceId", edge.sequence}, {"released", edge.released}};
  });
  if (state.position) root["agvPosition"] = agv_position_json(*state.position);
  if (state.velocity) root["velocity"] = velocity_json(*state.velocity);
  if (state.loads) root["loads"] = json(*state.loads, json::object());
  root["actionStates"] = list_of(state.actions, action_state_json);
  root["batteryState"] = {{"batteryCharge", state.battery.charge_percent},
                          {"charging", state.battery.charging}};
  root["errors"] = list_of(state.errors, error_json);
  root["safetyState"] = {{"eStop", word_of(kEmergencyStops, state.emergency_stop)},
                         {"fieldViolation", state.field_violation}};
  return text(root);
}

std::string to_json(const Visualization& visualization) {
  json root = header_json(visualization.header);
  if (visualization.position) root["agvPosition"] = agv_position_json(*visualization.position);
  if (visualization.velocity) root["velocity"] = velocity_json(*visualization.velocity);
  return text(root);
}

std::string to_json(const Connection& connection) {
  json root = header_json(connection.header);
  root["connectionState"] = word_of(kConnectionStates, connection.state);
  return text(root);
}

}  // namespace stepwright::fleet::vda5050
