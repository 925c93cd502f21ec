#include <nlohmann/json.hpp>

#include "supervisor/fleet/vda5050/write_message.h"

namespace stepwright::fleet::vda5050 {

namespace {

using json = nlohmann::ordered_json;

json able(const char* type, std::initializer_list<const char*> scopes, const char* blocking) {
  return {{"actionType", type}, {"actionScopes", scopes}, {"blockingTypes", {blocking}}};
}

// What orders and instant actions of this library make use of.
json features_json() {
  json optional = json::array();
  for (const char* parameter :
       {"order.nodes.nodePosition", "order.nodes.nodePosition.theta",
        "order.nodes.nodePosition.allowedDeviationXY", "order.nodes.nodePosition.allowedDeviationTheta",
        "order.edges.maxSpeed", "order.edges.orientation", "order.edges.orientationType",
        "order.edges.rotationAllowed", "order.edges.length", "order.edges.trajectory"}) {
    optional.push_back({{"parameter", parameter}, {"support", "SUPPORTED"}});
  }
  json actions = json::array();
  for (const char* type : {"cancelOrder", "startPause", "stopPause", "stateRequest", "factsheetRequest"}) {
    actions.push_back(able(type, {"INSTANT"}, "NONE"));
  }
  for (const char* type : {"startCharging", "stopCharging"}) {
    actions.push_back(able(type, {"INSTANT", "NODE"}, "HARD"));
  }
  for (const char* type : {"pick", "drop"}) {
    json action = able(type, {"NODE"}, "HARD");
    action["actionParameters"] = json::array();
    for (const auto& [key, kind] :
         {std::pair{"stationName", "STRING"}, std::pair{"loadId", "STRING"}, std::pair{"amount", "NUMBER"}}) {
      action["actionParameters"].push_back({{"key", key}, {"valueDataType", kind}, {"isOptional", true}});
    }
    actions.push_back(std::move(action));
  }
  return {{"optionalParameters", optional}, {"agvActions", actions}};
}

json geometry_json(const Factsheet& sheet) {
  json wheels = json::array();
  for (const Wheel& wheel : sheet.wheels) {
    json position = {{"x", wheel.x_m}, {"y", wheel.y_m}};
    if (!wheel.steered) position["theta"] = 0.0;
    wheels.push_back({{"type", wheel.driven ? "DRIVE" : "FIXED"},
                      {"isActiveDriven", wheel.driven},
                      {"isActiveSteered", wheel.steered},
                      {"position", position},
                      {"diameter", sheet.type.wheel_diameter_m},
                      {"width", sheet.type.wheel_width_m}});
  }
  json corners = json::array();
  for (const Corner& corner : sheet.outline) corners.push_back({{"x", corner.x_m}, {"y", corner.y_m}});
  return {{"wheelDefinitions", wheels},
          {"envelopes2d", json::array({{{"set", "outline"}, {"polygonPoints", corners}}})}};
}

}  // namespace

std::string to_json(const Factsheet& sheet) {
  const json root = {
      {"headerId", sheet.header.header_id},
      {"timestamp", to_text(sheet.header.timestamp)},
      {"version", sheet.header.version},
      {"manufacturer", sheet.header.manufacturer},
      {"serialNumber", sheet.header.serial_number},
      {"typeSpecification",
       {{"seriesName", sheet.type.series},
        {"agvKinematic", "THREEWHEEL"},
        {"agvClass", "FORKLIFT"},
        {"maxLoadMass", sheet.type.max_load_kg},
        {"localizationTypes", json::array({"NATURAL"})},
        {"navigationTypes", json::array({"VIRTUAL_LINE_GUIDED"})}}},
      {"physicalParameters",
       {{"speedMin", sheet.speed_min_mps},
        {"speedMax", sheet.speed_max_mps},
        {"accelerationMax", sheet.type.acceleration_mps2},
        {"decelerationMax", sheet.type.deceleration_mps2},
        {"heightMin", sheet.type.height_min_m},
        {"heightMax", sheet.type.height_max_m},
        {"width", sheet.width_m},
        {"length", sheet.length_m}}},
      {"protocolLimits",
       {{"maxStringLens", json::object()},
        {"maxArrayLens", json::object()},
        {"timing", {{"minOrderInterval", 0.0}, {"minStateInterval", 0.0}, {"defaultStateInterval", 30.0}}}}},
      {"protocolFeatures", features_json()},
      {"agvGeometry", geometry_json(sheet)},
      {"loadSpecification", {{"loadPositions", sheet.type.load_positions}}}};
  return root.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace stepwright::fleet::vda5050
