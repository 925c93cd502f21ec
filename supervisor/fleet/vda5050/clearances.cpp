#include "supervisor/fleet/vda5050/clearances.h"

#include <algorithm>

namespace stepwright::fleet::vda5050 {

Clearances::Clearances(const FleetPlan& plan) {
  vehicles_.resize(plan.missions.size());
  for (std::size_t v = 0; v < vehicles_.size(); ++v) {
    vehicles_[v].polygons.resize(plan.missions[v].grown.envelope.polygons.size());
  }
  for (const Precedence& order : plan.schedule.precedences) {
    vehicles_[order.first.vehicle].polygons[order.first.polygon].followers.push_back(order.second);
    ++vehicles_[order.second.vehicle].polygons[order.second.polygon].awaited;
  }
  for (Vehicle& vehicle : vehicles_) advance_clear(vehicle);
}

bool Clearances::advance_clear(Vehicle& vehicle) const {
  const std::uint32_t before = vehicle.clear;
  while (vehicle.clear < vehicle.polygons.size() && vehicle.polygons[vehicle.clear].awaited == 0) {
    ++vehicle.clear;
  }
  return vehicle.clear > before;
}

std::vector<std::uint32_t> Clearances::reached(std::uint32_t vehicle, std::uint32_t polygon) {
  vehicles_[vehicle].reached = std::max(vehicles_[vehicle].reached, polygon);
  std::vector<std::uint32_t> grown, open{vehicle};
  while (!open.empty()) {
    Vehicle& here = vehicles_[open.back()];
    open.pop_back();
    // Within `reached` and allowed to be there: all before it is left.
    const std::uint32_t within = std::min(here.reached, here.clear == 0 ? 0 : here.clear - 1);
    for (; here.left < within; ++here.left) {
      for (const PolygonRef& follower : here.polygons[here.left].followers) {
        Vehicle& other = vehicles_[follower.vehicle];
        --other.polygons[follower.polygon].awaited;
        if (!advance_clear(other)) continue;
        if (std::ranges::find(grown, follower.vehicle) == grown.end()) grown.push_back(follower.vehicle);
        open.push_back(follower.vehicle);
      }
    }
  }
  return grown;
}

}  // namespace stepwright::fleet::vda5050
