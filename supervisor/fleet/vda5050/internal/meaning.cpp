#include "supervisor/fleet/vda5050/internal/meaning.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace stepwright::fleet::vda5050 {

namespace {

using nlohmann::json;

std::uint64_t sequence_of(const json& item) {
  return static_cast<std::uint64_t>(item.at("sequenceId").get<double>());
}

const std::string& text_of(const json& object, const char* name) {
  return object.at(name).get_ref<const std::string&>();
}

void ids_differ(const json& list, const char* name, const Place& place, std::set<std::string>& seen,
                Findings& findings) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string& id = text_of(list[k], name);
    if (seen.insert(id).second) continue;
    const Place item = place.at(k);
    findings.add("F0904", item.at(name), "'" + id + "' is the id of another action, too");
  }
}

void parameters_differ(const json& actions, const Place& place, Findings& findings) {
  for (std::size_t k = 0; k < actions.size(); ++k) {
    if (!actions[k].contains("actionParameters")) continue;
    const Place item = place.at(k);
    const Place list = item.at("actionParameters");
    std::set<std::string> seen;
    const json& parameters = actions[k]["actionParameters"];
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const std::string& key = text_of(parameters[p], "key");
      if (seen.insert(key).second) continue;
      const Place at = list.at(p);
      findings.add("F0904", at.at("key"), "'" + key + "' comes twice");
    }
  }
}

void apply_actions(const json& item, const Place& place, std::set<std::string>& ids, Findings& findings) {
  const Place actions = place.at("actions");
  ids_differ(item.at("actions"), "actionId", actions, ids, findings);
  parameters_differ(item.at("actions"), actions, findings);
}

void apply_trajectory(const json& trajectory, const Place& place, Findings& findings) {
  const json& knots = trajectory.at("knotVector");
  const std::size_t points = trajectory.at("controlPoints").size();
  const auto degree = static_cast<std::size_t>(trajectory.at("degree").get<double>());
  const Place at = place.at("knotVector");
  if (points < degree + 1) {
    findings.add("F0904", place.at("controlPoints"), "has too few points for the degree",
                 "a curve of degree n has n + 1 points at least");
  }
  if (knots.size() != points + degree + 1) {
    findings.add(
        "F0904", at,
        "has " + std::to_string(knots.size()) + " knots instead of " + std::to_string(points + degree + 1),
        "one for each point, and degree + 1 more");
  }
  for (std::size_t k = 1; k < knots.size(); ++k) {
    if (knots[k].get<double>() < knots[k - 1].get<double>()) {
      findings.add("F0904", at.at(k), "is less than the knot before it");
    }
  }
}

// Nodes or edges: sequenceIds of the right parity, one after the other; no base behind the horizon.
void apply_sequence(const json& list, const Place& place, std::uint64_t parity, std::uint64_t step,
                    Findings& findings) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::uint64_t sequence = sequence_of(list[k]);
    const Place item = place.at(k);
    if (sequence % 2 != parity) {
      findings.add("F0904", item.at("sequenceId"),
                   std::to_string(sequence) + (parity == 0 ? " is odd" : " is even"),
                   "nodes have even sequenceIds, edges odd ones");
    }
    if (k == 0) continue;
    const std::uint64_t before = sequence_of(list[k - 1]);
    if (step > 0 ? sequence != before + step : sequence <= before) {
      findings.add("F0904", item.at("sequenceId"),
                   std::to_string(sequence) + " does not follow " + std::to_string(before));
    }
    if (list[k].at("released").get<bool>() && !list[k - 1].at("released").get<bool>()) {
      findings.add("F0904", item.at("released"), "the base goes on behind the horizon",
                   "nothing is released after what is not");
    }
  }
}

void apply_edge(const json& order, std::size_t k, const Place& place, Findings& findings) {
  const json& edge = order.at("edges")[k];
  const json& from = order.at("nodes")[k];
  const json& to = order.at("nodes")[k + 1];
  if (sequence_of(edge) != sequence_of(from) + 1) {
    findings.add("F0904", place.at("sequenceId"), "does not lie between those of its nodes");
  }
  if (text_of(edge, "startNodeId") != text_of(from, "nodeId")) {
    findings.add("F0904", place.at("startNodeId"), "is not the node before the edge");
  }
  if (text_of(edge, "endNodeId") != text_of(to, "nodeId")) {
    findings.add("F0904", place.at("endNodeId"), "is not the node behind the edge");
  }
  const bool both = from.at("released").get<bool>() && to.at("released").get<bool>();
  if (edge.at("released").get<bool>() != both) {
    findings.add("F0904", place.at("released"), "does not fit its nodes",
                 "an edge is released if both its nodes are");
  }
  if (edge.contains("trajectory")) {
    apply_trajectory(edge["trajectory"], place.at("trajectory"), findings);
  }
}

void apply_order(const json& order, Findings& findings) {
  const Place root;
  const Place nodes = root.at("nodes"), edges = root.at("edges");
  const std::size_t count = order.at("nodes").size();
  if (order.at("edges").size() + 1 != count) {
    findings.add("F0904", edges,
                 std::to_string(order.at("edges").size()) + " edges join " + std::to_string(count) + " nodes",
                 "there is one edge less than nodes");
    return;
  }
  if (order.at("orderUpdateId").get<double>() == 0.0 && sequence_of(order.at("nodes")[0]) != 0) {
    const Place first = nodes.at(std::size_t{0});
    findings.add("F0904", first.at("sequenceId"), "a new order begins with sequenceId 0");
  }
  apply_sequence(order.at("nodes"), nodes, 0, 2, findings);
  apply_sequence(order.at("edges"), edges, 1, 2, findings);
  std::set<std::string> actions;
  for (std::size_t k = 0; k < count; ++k) {
    apply_actions(order.at("nodes")[k], nodes.at(k), actions, findings);
    if (k + 1 == count) continue;
    apply_edge(order, k, edges.at(k), findings);
    apply_actions(order.at("edges")[k], edges.at(k), actions, findings);
  }
}

void apply_maps(const json& state, Findings& findings) {
  if (!state.contains("maps")) return;
  const Place root;
  const Place maps = root.at("maps");
  std::set<std::string> enabled;
  for (std::size_t k = 0; k < state["maps"].size(); ++k) {
    const json& map = state["maps"][k];
    if (text_of(map, "mapStatus") != "ENABLED" || enabled.insert(text_of(map, "mapId")).second) continue;
    const Place item = maps.at(k);
    findings.add("F0904", item.at("mapStatus"), "another version of the map is enabled, too");
  }
}

void apply_state(const json& state, Findings& findings) {
  const Place root;
  apply_sequence(state.at("nodeStates"), root.at("nodeStates"), 0, 0, findings);
  apply_sequence(state.at("edgeStates"), root.at("edgeStates"), 1, 0, findings);
  if (static_cast<std::uint64_t>(state.at("lastNodeSequenceId").get<double>()) % 2 != 0) {
    findings.add("F0904", root.at("lastNodeSequenceId"), "is odd",
                 "nodes have even sequenceIds, edges odd ones");
  }
  std::set<std::string> actions;
  ids_differ(state.at("actionStates"), "actionId", root.at("actionStates"), actions, findings);
  apply_maps(state, findings);
  const json& edges = state.at("edgeStates");
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (!edges[k].contains("trajectory")) continue;
    const Place list = root.at("edgeStates");
    const Place item = list.at(k);
    apply_trajectory(edges[k]["trajectory"], item.at("trajectory"), findings);
  }
}

}  // namespace

void apply_meaning(Topic topic, const json& root, Findings& findings) {
  if (topic == Topic::Order) apply_order(root, findings);
  if (topic == Topic::State) apply_state(root, findings);
  if (topic == Topic::InstantActions) {
    std::set<std::string> actions;
    apply_actions(root, {}, actions, findings);
  }
}

}  // namespace stepwright::fleet::vda5050
