#pragma once

// The order of one vehicle: all its nodes and edges from sequenceId 0 on, how many are released, traversed
// and acknowledged. Knows nothing of other vehicles. One thread at a time.
//
//   VehicleOrder order(address, "shift7.v1.1", mission, route, options);
//   send(order.first(released, now));
//   if (order.release(polygons)) send(order.update(now));

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/fleet_orders.h"

namespace stepwright::fleet::vda5050 {

// Data of a node beyond those of the standard.
struct Waypoint {
  std::uint32_t polygon = 0;  // within which the vehicle is, at the latest, once it has passed the node
  std::uint32_t next = 0;     // polygon of the edge behind it
  double arc_m = 0.0;         // on the path of the mission; negative: before it begins
  std::vector<geometry::PathPose> way;  // of the edge behind it, both ends included; empty at the end
  std::vector<Stop> stops;
};

class VehicleOrder {
 public:
  VehicleOrder(std::string id, const OrderOptions& options, bool charging);

  // Appends the route behind the last node that is kept. `keep`: nodes from the front that stay; the first
  // node of the route is the last of these, or the first of all.
  void lay(const VehicleMission& mission, const Route& route, std::size_t keep);
  // Position of a kept node in another plan.
  void set_place(std::size_t node, std::uint32_t polygon, double arc_m);

  // Edges whose polygon is one of the first `clear` ones become base. True if the base has grown.
  bool release(std::uint32_t clear);
  // Messages to send: first the whole order, then updates from the last decision point on.
  Order first(Header header);
  Order update(Header header);

  // F0907 where it contradicts the order. Else the polygon that is reached; nothing where the vehicle says
  // nothing new.
  result::Result<std::optional<std::uint32_t>> take(const State& state, const std::string& source);

  // How many nodes lie before `arc_m + reach_m`.
  std::size_t passed(double arc_m, double reach_m) const;

  // True for what was sent and is not acknowledged, and for what is older than that.
  bool sent(const Order& order) const;

  const std::string& id() const { return whole_.order_id; }
  const Order& whole() const { return whole_; }
  const std::vector<Waypoint>& waypoints() const { return waypoints_; }
  std::size_t released() const { return released_; }  // index of the decision point
  std::optional<std::size_t> traversed() const { return traversed_; }
  bool done() const { return done_; }
  std::vector<Order>& pending() { return pending_; }

 private:
  Node node_for(const VehicleMission& mission, const RouteNode& at, std::size_t index);
  Edge edge_for(const VehicleMission& mission, std::size_t from, std::size_t to, std::size_t index) const;
  std::vector<Action> actions_for(const VehicleMission& mission, const RouteNode& at,
                                  std::size_t index) const;
  std::string part_id(char kind, std::size_t sequence) const;
  void mark_released();

  const OrderOptions* options_;
  bool charging_;  // when the order is given: it has to stop that first
  std::uint32_t revision_ = 0;
  Order whole_;
  std::vector<Waypoint> waypoints_;
  std::size_t released_ = 0;
  std::size_t sent_ = 0;  // index of the decision point that the vehicle was told last
  std::optional<std::size_t> traversed_;
  bool done_ = false;
  std::vector<Order> pending_;  // sent and not acknowledged
};

}  // namespace stepwright::fleet::vda5050
