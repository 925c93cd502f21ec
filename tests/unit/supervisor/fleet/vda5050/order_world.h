#pragma once

// Master control and vehicles with a channel between them that may lose messages, and a judge of every
// message and of who may be where. Time goes on by a second with each message.
//
//   OrderWorld world(plan);
//   while (world.drive("v1")) {}
//   EXPECT_EQ(world.faults(), "");

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "tests/support/fleet/split_mix.h"
#include "tests/support/vda5050/made_missions.h"
#include "tests/support/vda5050/standard_vehicle.h"

namespace stepwright::fleet::vda5050 {

class OrderWorld {
 public:
  explicit OrderWorld(FleetPlan plan, OrderOptions options = {});

  // From here on each message is lost with this probability. `random` must outlive the world.
  void lose(support::SplitMix64& random, double probability);

  // The vehicle goes on by one node, if it may, and says its state. False if it had to stay.
  bool drive(const std::string& name, bool charging = false);
  // Sends messages again that the vehicle has not acknowledged.
  void repeat(const std::string& name);
  void cancel(const std::string& name);
  std::vector<Order> adopt(FleetPlan next);

  // Errors so far, one line for each.
  std::string faults() const { return faults_; }
  bool all_arrived() const;
  std::size_t updates() const { return updates_; }
  std::size_t updates(const std::string& name) const;
  const Order& sent_first(const std::string& name) const { return first_.at(name); }
  FleetOrders& orders() { return *orders_; }
  support::StandardVehicle& vehicle(const std::string& name) { return vehicles_.at(name); }

 private:
  void send(const Order& order, bool again);
  void tell(const std::string& name, bool charging);
  void judge_places();
  bool lost();
  void fault(const std::string& what) { faults_ += what + "\n"; }

  FleetPlan plan_;
  std::optional<FleetOrders> orders_;
  std::map<std::string, support::StandardVehicle> vehicles_;
  std::map<std::string, Order> first_, held_;  // held: what a vehicle has that lost nothing
  std::map<std::string, std::size_t> updates_of_;
  std::size_t updates_ = 0;
  support::SplitMix64* random_ = nullptr;
  double probability_ = 0.0;
  Timestamp now_{};
  std::string faults_;
};

}  // namespace stepwright::fleet::vda5050
