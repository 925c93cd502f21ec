// Going on with another plan.

#include <cmath>
#include <numbers>
#include <utility>

#include "supervisor/fleet/vda5050/internal/dispatch.h"

namespace stepwright::fleet::vda5050 {

namespace {

// Where on the mission's path a node of the base is; negative before its begin.
double arc_of(const VehicleOrder& order, std::size_t node, const BaseMatch& match) {
  return match.decision_arc_m - base_length_m(order, node, order.released());
}

// The last polygon within which the vehicle is for sure once it has reported the node.
std::uint32_t polygon_reached(const VehicleOrder& order, std::size_t node, const BaseMatch& match,
                              const VehicleMission& mission) {
  const double early_m = order.whole().nodes[node].position->deviation_xy_m.value_or(0.0);
  const double arc_m = arc_of(order, node, match) - early_m;
  std::uint32_t polygon = 0;
  while (polygon + 1 < mission.grown.visits.size() && mission.grown.visits[polygon + 1].entry_m <= arc_m) {
    ++polygon;
  }
  return polygon;
}

// The first polygon within which a vehicle at the pose is.
std::uint32_t polygon_of(const VehicleMission& mission, std::size_t pose) {
  std::uint32_t polygon = 0;
  while (mission.grown.visits[polygon].last_pose < pose) ++polygon;
  return polygon;
}

}  // namespace

FleetOrders::Dispatch::Fit FleetOrders::Dispatch::fit(const FleetPlan& next, const Places& places) const {
  Fit fit{Clearances(next), {}, {}};
  const bool shown = options_.releases == Releases::ByController;
  for (std::size_t v = 0; shown && v < next.missions.size(); ++v) {
    const auto at = places.find(next.missions[v].vehicle);
    if (at != places.end()) fit.clearances.reached(static_cast<std::uint32_t>(v), at->second.left);
  }
  for (std::size_t v = 0; v < next.missions.size(); ++v) {
    const VehicleMission& mission = next.missions[v];
    const Vehicle* const vehicle = find(mission.vehicle);
    if (vehicle == nullptr || !vehicle->order || !vehicle->cancel_id.empty()) continue;
    const VehicleOrder& order = *vehicle->order;
    if (order.done()) continue;
    const auto match = match_base(order, mission);
    if (!match) {
      fit.affected.push_back(mission.vehicle);
      continue;
    }
    fit.matches.emplace(mission.vehicle, *match);
    if (!order.traversed() || shown) continue;
    fit.clearances.reached(static_cast<std::uint32_t>(v),
                           polygon_reached(order, *order.traversed(), *match, mission));
  }
  for (std::size_t v = 0; v < next.missions.size(); ++v) {
    const auto match = fit.matches.find(next.missions[v].vehicle);
    if (match == fit.matches.end()) continue;
    const std::uint32_t needed = polygon_of(next.missions[v], match->second.decision_pose);
    if (needed < fit.clearances.clear(static_cast<std::uint32_t>(v))) continue;
    // Somebody else is to come first where the base leads already.
    fit.affected.push_back(match->first);
    fit.matches.erase(match);
  }
  return fit;
}

std::vector<std::string> FleetOrders::Dispatch::affected(const FleetPlan& next, const Places& places) const {
  return fit(next, places).affected;
}

bool FleetOrders::Dispatch::stands_at(const Vehicle& vehicle, const VehicleMission& mission) const {
  const geometry::Pose& start = mission.path.front().pose;
  geometry::Pose here = start;
  if (vehicle.position) {
    here = {vehicle.position->x_m, vehicle.position->y_m, vehicle.position->theta_rad};
  } else if (vehicle.order) {
    const NodePosition& last = *vehicle.order->whole().nodes.back().position;
    here = {last.x_m, last.y_m, last.theta_rad.value_or(start.heading_rad)};
  }
  const double turn = std::remainder(here.heading_rad - start.heading_rad, 2.0 * std::numbers::pi);
  return geometry::distance(here.position(), start.position()) <= options_.route.start_deviation_m &&
         std::abs(turn) <= options_.route.start_deviation_rad;
}

result::Diagnostics FleetOrders::Dispatch::hindrances(const FleetPlan& next, const Places& places) const {
  result::Diagnostics wrong;
  const auto add = [&](const std::string& message, const std::string& hint) {
    wrong.push_back({.code = "F0908",
                     .severity = result::Severity::Error,
                     .where = {},
                     .message = message,
                     .hint = hint});
  };
  for (const std::string& name : affected(next, places)) {
    add("the base of '" + name + "' does not fit the plan", "cancel its order and plan from where it stands");
  }
  const auto planned = [&](const std::string& name) {
    return std::ranges::any_of(next.missions, [&](const auto& m) { return m.vehicle == name; });
  };
  for (const auto& [name, vehicle] : vehicles_) {
    if (vehicle.order && !vehicle.cancel_id.empty()) {
      add("'" + name + "' has not confirmed yet that its order is cancelled", "wait for its state");
    }
    if (vehicle.order && !vehicle.order->done() && !planned(name)) {
      add("'" + name + "' has an order and is not in the plan", "cancel its order, or plan for it as well");
    }
  }
  // Of vehicles that one controller drives the order begins where they are.
  if (options_.releases == Releases::ByController) return wrong;
  for (const VehicleMission& mission : next.missions) {
    const Vehicle* const vehicle = find(mission.vehicle);
    const bool fresh = vehicle != nullptr && (!vehicle->order || vehicle->order->done());
    if (fresh && to_do(mission) && !stands_at(*vehicle, mission)) {
      add("the path of '" + mission.vehicle + "' does not begin where the vehicle stands",
          "plan from the position that it reports");
    }
  }
  return wrong;
}

void FleetOrders::Dispatch::go_on(Vehicle& vehicle, const VehicleMission& mission, const BaseMatch& match) {
  VehicleOrder& order = *vehicle.order;
  for (std::size_t k = 0; k <= order.released(); ++k) {
    const bool ahead = k >= order.traversed().value_or(0);
    const std::uint32_t polygon = ahead ? polygon_reached(order, k, match, mission) : 0;
    order.set_place(k, polygon, arc_of(order, k, match));
  }
  order.lay(mission, route_of(mission, options_.route, match.decision_pose), order.released() + 1);
}

std::vector<Order> FleetOrders::Dispatch::adopt(FleetPlan next, Timestamp now, const Places& places) {
  Fit fit = this->fit(next, places);
  plan_ = std::move(next);
  clearances_ = std::move(fit.clearances);
  meet();
  std::vector<Order> orders;
  for (auto& [name, vehicle] : vehicles_) {
    vehicle.cancel_id.clear();
    const auto match = fit.matches.find(name);
    if (match == fit.matches.end()) vehicle.order.reset();
    const auto index = index_.find(name);
    if (index == index_.end()) continue;
    const VehicleMission& mission = plan_.missions[index->second];
    if (match == fit.matches.end()) {
      if (auto order = new_order(vehicle, index->second, now, places)) orders.push_back(*std::move(order));
      continue;
    }
    go_on(vehicle, mission, match->second);
    vehicle.order->release(clearances_.clear(index->second));
    orders.push_back(vehicle.order->update(make_header(vehicle.address, Topic::Order, vehicle.ids, now)));
  }
  return orders;
}

}  // namespace stepwright::fleet::vda5050
