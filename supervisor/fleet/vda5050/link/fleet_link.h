#pragma once

// The orders of a fleet on a broker: what vehicles say comes in, first orders and updates go out, and what a
// vehicle has not acknowledged in time goes out again. A cancelOrder that no state shows goes out again
// `cancel_attempts` times; then it is told once (F0910), and bases stay as they are.
//
// One thread at a time; waits only in `turn`.
//
//   FleetLink link(std::move(orders), {"v1", "v2"}, client, {});
//   while (!link.all_arrived()) for (const auto& wrong : link.turn(100ms).wrong) log(wrong);

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "runtime/ground/mqtt/client.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"

namespace stepwright::vda5050_link {

struct LinkOptions {
  std::string interface_name = "uagv";
  std::string manufacturer = "Stepwright";
  std::chrono::milliseconds resend{1000};  // without a sign of a vehicle that it has a message
  std::size_t cancel_attempts = 10;
};

struct LinkNews {
  result::Diagnostics wrong;  // messages that were refused, complaints of vehicles, cancelOrders in vain
  std::vector<std::string> online;  // vehicles whose connection has come
  std::vector<std::string> lost;    // ... has gone, by its own word or by the broker's last will
};

class FleetLink {
 public:
  // `client` must outlive the link. `vehicles` are those of the plan.
  FleetLink(fleet::vda5050::FleetOrders orders, std::set<std::string> vehicles, mqtt::Client& client,
            LinkOptions options);

  // Waits for messages at most this long and handles all that are there.
  LinkNews turn(std::chrono::milliseconds wait);

  // Takes the controller's view (Releases::ByController): places for first orders, bases that grow.
  LinkNews place(const fleet::vda5050::Places& places);
  // As FleetOrders::cancel and adopt, with their messages.
  [[nodiscard]] result::Result<void> cancel(const std::string& vehicle);
  [[nodiscard]] result::Result<void> adopt(fleet::FleetPlan next, const fleet::vda5050::Places& places);

  bool all_arrived() const;
  fleet::vda5050::FleetOrders& orders() { return orders_; }
  const fleet::vda5050::FleetOrders& orders() const { return orders_; }
  // Messages published so far, repetitions included.
  std::size_t published() const { return published_; }
  std::size_t repeated() const { return repeated_; }

 private:
  void handle(const mqtt::Message& message, LinkNews& news);
  void take_state(const mqtt::Message& message, const fleet::vda5050::Address& address, LinkNews& news);
  void take_connection(const mqtt::Message& message, const fleet::vda5050::Address& address, LinkNews& news);
  void publish(const fleet::vda5050::Order& order, LinkNews& news);
  void publish(const fleet::vda5050::InstantActions& actions, LinkNews& news);
  void repeat(LinkNews& news);
  void repeat_cancels(LinkNews& news);

  struct Cancelling {
    std::chrono::steady_clock::time_point sent;
    std::size_t attempts = 1;
  };

  fleet::vda5050::FleetOrders orders_;
  std::set<std::string> vehicles_;
  mqtt::Client& client_;
  LinkOptions options_;
  bool begun_ = false;
  fleet::vda5050::Places places_;
  std::map<std::string, Cancelling> cancels_;
  LinkNews later_;                                                     // of what is sent between two turns
  std::map<std::string, std::chrono::steady_clock::time_point> sent_;  // the last order of each vehicle
  std::size_t published_ = 0;
  std::size_t repeated_ = 0;
};

}  // namespace stepwright::vda5050_link
