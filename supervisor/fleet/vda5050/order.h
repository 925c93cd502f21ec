#pragma once

// Orders and instant actions as values (VDA 5050 2.1.0, sections 6.6 and 6.9): metres, radians, m/s; names of
// members as in the standard, with units. Values; any thread may read.
//
//   Order order{.header = header, .order_id = "shift7.v1", .nodes = {...}, .edges = {...}};
//   publish(to_json(order));

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "supervisor/fleet/vda5050/header.h"

namespace stepwright::fleet::vda5050 {

enum class Blocking : std::uint8_t {
  None,  // while driving and beside other actions
  Soft,  // beside other actions, not while driving
  Hard,  // alone
};

using ParameterValue = std::variant<bool, double, std::string>;

struct Action {
  std::string type;  // "pick"
  std::string id;    // unique
  Blocking blocking = Blocking::Hard;
  std::vector<std::pair<std::string, ParameterValue>> parameters;

  friend bool operator==(const Action&, const Action&) = default;
};

struct NodePosition {
  double x_m = 0.0;
  double y_m = 0.0;
  std::optional<double> theta_rad;       // -pi to pi
  std::optional<double> deviation_xy_m;  // 0: as exactly as the vehicle can
  std::optional<double> deviation_theta_rad;
  std::string map_id;

  friend bool operator==(const NodePosition&, const NodePosition&) = default;
};

struct Node {
  std::string id;
  std::uint32_t sequence = 0;  // even
  std::string description;     // left out where empty
  bool released = false;
  std::optional<NodePosition> position;
  std::vector<Action> actions;

  friend bool operator==(const Node&, const Node&) = default;
};

struct ControlPoint {
  double x_m = 0.0;
  double y_m = 0.0;

  friend bool operator==(const ControlPoint&, const ControlPoint&) = default;
};

// A NURBS with weights of one.
struct Trajectory {
  std::uint32_t degree = 1;
  std::vector<double> knots;  // 0 to 1, never falling; control points + degree + 1 of them
  std::vector<ControlPoint> points;

  friend bool operator==(const Trajectory&, const Trajectory&) = default;
};

struct Edge {
  std::string id;
  std::uint32_t sequence = 0;  // odd
  bool released = false;
  std::string start_node;
  std::string end_node;
  std::optional<double> max_speed_mps;
  std::optional<double> orientation_rad;  // tangential: 0 forwards, pi backwards
  std::optional<bool> rotation_allowed;
  std::optional<double> length_m;
  std::optional<Trajectory> trajectory;
  std::vector<Action> actions;

  friend bool operator==(const Edge&, const Edge&) = default;
};

struct Order {
  Header header;
  std::string order_id;
  std::uint32_t update_id = 0;
  std::vector<Node> nodes;  // one at least
  std::vector<Edge> edges;  // one less than nodes

  friend bool operator==(const Order&, const Order&) = default;
};

struct InstantActions {
  Header header;
  std::vector<Action> actions;

  friend bool operator==(const InstantActions&, const InstantActions&) = default;
};

// The last node of the base; nothing where no node is released.
std::optional<std::size_t> decision_point(const Order& order);

}  // namespace stepwright::fleet::vda5050
