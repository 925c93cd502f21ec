#pragma once

// State of FleetOrders: the plan, its clearances, the order of each vehicle. One thread at a time.
//
//   FleetOrders::Dispatch dispatch(plan, options);

#include <algorithm>
#include <map>
#include <optional>

#include "supervisor/fleet/vda5050/clearances.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/internal/base_match.h"
#include "supervisor/fleet/vda5050/internal/vehicle_order.h"

namespace stepwright::fleet::vda5050 {

// Whether there is anything to send.
inline bool to_do(const VehicleMission& mission) {
  return mission.path.size() > 1 || !mission.stops.empty();
}

// Everything that a fleet has; by name, since plans may list vehicles in another order.
class FleetOrders::Dispatch {
 public:
  struct Vehicle {
    Address address;
    HeaderIds ids;
    std::optional<VehicleOrder> order;
    std::uint32_t orders = 0;  // given so far
    std::uint32_t instants = 0;
    std::string cancel_id;     // of the cancelOrder that is not confirmed; empty: none
    bool cancel_came = false;  // a state shows it, in whatever status
    std::optional<AgvPosition> position;
    bool charging = false;
  };

  Dispatch(FleetPlan plan, OrderOptions options)
      : options_(std::move(options)), plan_(std::move(plan)), clearances_(plan_) {
    meet();
  }

  static result::Diagnostics check_plan(const FleetPlan& plan, const OrderOptions& options);
  std::vector<Order> begin(Timestamp now, const Places& places);
  Progress place(const Places& places, Timestamp now);
  std::optional<InstantActions> unconfirmed(const std::string& name, Timestamp now);
  Progress take(const State& state, Timestamp now);
  std::vector<Order> unacknowledged(const std::string& name, Timestamp now);
  // F0908: why the plan cannot be adopted now.
  result::Diagnostics hindrances(const FleetPlan& next, const Places& places) const;
  std::vector<std::string> affected(const FleetPlan& next, const Places& places) const;
  InstantActions instant(const std::string& name, const std::string& type, Timestamp now);
  InstantActions cancel(const std::string& name, Timestamp now);
  // Requires a plan without hindrances.
  std::vector<Order> adopt(FleetPlan next, Timestamp now, const Places& places);
  const Vehicle* find(const std::string& name) const {
    const auto found = vehicles_.find(name);
    return found == vehicles_.end() ? nullptr : &found->second;
  }
  const OrderOptions& options() const { return options_; }

 private:
  void meet();
  // Nothing where there is nothing left to do.
  std::optional<Order> new_order(Vehicle& vehicle, std::size_t index, Timestamp now, const Places& places);
  std::vector<Order> extend(const std::vector<std::uint32_t>& grown, Timestamp now);
  // How the bases of a fleet fit another plan.
  struct Fit {
    Clearances clearances;                     // of that plan, with what has been reached
    std::map<std::string, BaseMatch> matches;  // of vehicles whose order goes on
    std::vector<std::string> affected;
  };
  Fit fit(const FleetPlan& next, const Places& places) const;
  void go_on(Vehicle& vehicle, const VehicleMission& mission, const BaseMatch& match);
  bool stands_at(const Vehicle& vehicle, const VehicleMission& mission) const;
  bool frozen() const {
    return std::ranges::any_of(vehicles_, [](const auto& v) { return !v.second.cancel_id.empty(); });
  }
  void warn(const State& state, const std::string& source, result::Diagnostics& wrong) const;

  OrderOptions options_;
  FleetPlan plan_;
  Clearances clearances_;
  std::map<std::string, Vehicle> vehicles_;
  std::map<std::string, std::uint32_t> index_;  // in the plan
};

}  // namespace stepwright::fleet::vda5050
