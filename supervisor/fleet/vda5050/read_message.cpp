#include "supervisor/fleet/vda5050/read_message.h"

#include <nlohmann/json.hpp>

#include "supervisor/fleet/vda5050/internal/document.h"
#include "supervisor/fleet/vda5050/internal/words.h"

namespace stepwright::fleet::vda5050 {

namespace {

using nlohmann::json;

// Everything below reads what the rules have accepted: members are there and of their types.

std::string text_of(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? std::string() : found->get<std::string>();
}

bool truth_of(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->get<bool>();
}

double number_of(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? 0.0 : found->get<double>();
}

std::optional<double> maybe_number(const json& object, const char* name) {
  if (!object.contains(name)) return std::nullopt;
  return number_of(object, name);
}

// Also 4.0, which is a whole number in JSON.
std::uint32_t count_of(const json& object, const char* name) {
  return static_cast<std::uint32_t>(object.at(name).get<double>());
}

template <typename Item, typename Convert>
std::vector<Item> items_of(const json& object, const char* name, Convert convert) {
  std::vector<Item> items;
  const auto found = object.find(name);
  if (found == object.end()) return items;
  items.reserve(found->size());
  for (const json& item : *found) items.push_back(convert(item));
  return items;
}

Header header_of(const json& root) {
  return {.header_id = count_of(root, "headerId"),
          .timestamp = timestamp_of(text_of(root, "timestamp")).value_or(Timestamp{}),
          .version = text_of(root, "version"),
          .manufacturer = text_of(root, "manufacturer"),
          .serial_number = text_of(root, "serialNumber")};
}

ParameterValue value_of(const json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  return value.dump(-1, ' ', false, json::error_handler_t::replace);  // lists and objects as their text
}

Action action_of(const json& object) {
  return {.type = text_of(object, "actionType"),
          .id = text_of(object, "actionId"),
          .blocking = value_of(kBlockings, text_of(object, "blockingType")),
          .parameters = items_of<std::pair<std::string, ParameterValue>>(
              object, "actionParameters", [](const json& parameter) {
                return std::pair(text_of(parameter, "key"), value_of(parameter.at("value")));
              })};
}

Node node_of(const json& object) {
  Node node{.id = text_of(object, "nodeId"),
            .sequence = count_of(object, "sequenceId"),
            .description = text_of(object, "nodeDescription"),
            .released = truth_of(object, "released"),
            .position = {},
            .actions = items_of<Action>(object, "actions", action_of)};
  const auto position = object.find("nodePosition");
  if (position == object.end()) return node;
  node.position = {.x_m = number_of(*position, "x"),
                   .y_m = number_of(*position, "y"),
                   .theta_rad = maybe_number(*position, "theta"),
                   .deviation_xy_m = maybe_number(*position, "allowedDeviationXY"),
                   .deviation_theta_rad = maybe_number(*position, "allowedDeviationTheta"),
                   .map_id = text_of(*position, "mapId")};
  return node;
}

Trajectory trajectory_of(const json& object) {
  return {.degree = count_of(object, "degree"),
          .knots = object.at("knotVector").get<std::vector<double>>(),
          .points = items_of<ControlPoint>(object, "controlPoints", [](const json& point) {
            return ControlPoint{number_of(point, "x"), number_of(point, "y")};
          })};
}

Edge edge_of(const json& object) {
  Edge edge{.id = text_of(object, "edgeId"),
            .sequence = count_of(object, "sequenceId"),
            .released = truth_of(object, "released"),
            .start_node = text_of(object, "startNodeId"),
            .end_node = text_of(object, "endNodeId"),
            .max_speed_mps = maybe_number(object, "maxSpeed"),
            .orientation_rad = maybe_number(object, "orientation"),
            .rotation_allowed = {},
            .length_m = maybe_number(object, "length"),
            .trajectory = {},
            .actions = items_of<Action>(object, "actions", action_of)};
  if (object.contains("rotationAllowed")) edge.rotation_allowed = truth_of(object, "rotationAllowed");
  if (object.contains("trajectory")) edge.trajectory = trajectory_of(object.at("trajectory"));
  return edge;
}

AgvPosition position_of(const json& object) {
  return {.x_m = number_of(object, "x"),
          .y_m = number_of(object, "y"),
          .theta_rad = number_of(object, "theta"),
          .map_id = text_of(object, "mapId"),
          .initialized = truth_of(object, "positionInitialized")};
}

ActionState action_state_of(const json& object) {
  return {.id = text_of(object, "actionId"),
          .type = text_of(object, "actionType"),
          .status = value_of(kStatuses, text_of(object, "actionStatus")),
          .result = text_of(object, "resultDescription")};
}

VehicleError error_of(const json& object) {
  return {.type = text_of(object, "errorType"),
          .level = value_of(kErrorLevels, text_of(object, "errorLevel")),
          .description = text_of(object, "errorDescription"),
          .references = items_of<std::pair<std::string, std::string>>(
              object, "errorReferences", [](const json& reference) {
                return std::pair(text_of(reference, "referenceKey"), text_of(reference, "referenceValue"));
              })};
}

void read_progress(const json& root, State& state) {
  state.order_id = text_of(root, "orderId");
  state.update_id = count_of(root, "orderUpdateId");
  state.last_node = text_of(root, "lastNodeId");
  state.last_node_sequence = count_of(root, "lastNodeSequenceId");
  state.nodes = items_of<NodeState>(root, "nodeStates", [](const json& node) {
    return NodeState{text_of(node, "nodeId"), count_of(node, "sequenceId"), truth_of(node, "released")};
  });
  state.edges = items_of<EdgeState>(root, "edgeStates", [](const json& edge) {
    return EdgeState{text_of(edge, "edgeId"), count_of(edge, "sequenceId"), truth_of(edge, "released")};
  });
  state.actions = items_of<ActionState>(root, "actionStates", action_state_of);
}

void read_condition(const json& root, State& state) {
  state.driving = truth_of(root, "driving");
  state.paused = truth_of(root, "paused");
  state.new_base_request = truth_of(root, "newBaseRequest");
  state.mode = value_of(kModes, text_of(root, "operatingMode"));
  if (root.contains("agvPosition")) state.position = position_of(root.at("agvPosition"));
  if (const auto velocity = root.find("velocity"); velocity != root.end()) {
    state.velocity = {.vx_mps = number_of(*velocity, "vx"),
                      .vy_mps = number_of(*velocity, "vy"),
                      .omega_radps = number_of(*velocity, "omega")};
  }
  if (root.contains("loads")) state.loads = root.at("loads").size();
  state.battery = {.charge_percent = number_of(root.at("batteryState"), "batteryCharge"),
                   .charging = truth_of(root.at("batteryState"), "charging")};
  state.errors = items_of<VehicleError>(root, "errors", error_of);
  state.emergency_stop = value_of(kEmergencyStops, text_of(root.at("safetyState"), "eStop"));
  state.field_violation = truth_of(root.at("safetyState"), "fieldViolation");
}

template <typename Message, typename Convert>
result::Result<Message> read(Topic topic, std::string_view text, const std::string& source, Convert convert) {
  Document document = read_document(topic, text, source);
  if (!document.wrong.empty()) return tl::unexpected(std::move(document.wrong));
  return convert(document.root);
}

}  // namespace

result::Result<State> read_state(std::string_view text, const std::string& source) {
  return read<State>(Topic::State, text, source, [](const json& root) {
    State state;
    state.header = header_of(root);
    read_progress(root, state);
    read_condition(root, state);
    return state;
  });
}

result::Result<Connection> read_connection(std::string_view text, const std::string& source) {
  return read<Connection>(Topic::Connection, text, source, [](const json& root) {
    return Connection{header_of(root), value_of(kConnectionStates, text_of(root, "connectionState"))};
  });
}

result::Result<Order> read_order(std::string_view text, const std::string& source) {
  return read<Order>(Topic::Order, text, source, [](const json& root) {
    return Order{.header = header_of(root),
                 .order_id = text_of(root, "orderId"),
                 .update_id = count_of(root, "orderUpdateId"),
                 .nodes = items_of<Node>(root, "nodes", node_of),
                 .edges = items_of<Edge>(root, "edges", edge_of)};
  });
}

result::Result<InstantActions> read_instant_actions(std::string_view text, const std::string& source) {
  return read<InstantActions>(Topic::InstantActions, text, source, [](const json& root) {
    return InstantActions{header_of(root), items_of<Action>(root, "actions", action_of)};
  });
}

}  // namespace stepwright::fleet::vda5050
