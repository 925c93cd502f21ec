#pragma once

// One vehicle on a broker, with a connection and a last will of its own: connection and factsheet (kept by
// the broker), state on every change and at least every `state_every`, visualization while its place changes,
// answers to what is asked of it. While there is no connection nothing is kept: after it everything is said
// anew.
//
// One thread at a time; nothing blocks. `orders` must outlive the link.
//
//   auto link = VehicleLink::open(setup, orders);
//   link->turn(reading_of(...), news);   // several times a second

#include <chrono>
#include <string>

#include "runtime/ground/mqtt/client.h"
#include "runtime/ground/result/result.h"
#include "supervisor/fleet/vda5050/factsheet.h"
#include "supervisor/fleet/vda5050/link/fleet_link.h"
#include "supervisor/fleet/vda5050/vehicle_side.h"

namespace stepwright::vda5050_link {

struct VehicleTimes {
  std::chrono::milliseconds state_every{30'000};
  std::chrono::milliseconds state_least{100};  // between two states
  std::chrono::milliseconds visualization{500};
};

struct VehicleSetup {
  fleet::vda5050::Address address;
  mqtt::Options broker;  // client id and last will are the link's own
  fleet::vda5050::Factsheet sheet;
  VehicleTimes times;
};

class VehicleLink {
 public:
  // As mqtt::Client::open.
  [[nodiscard]] static result::Result<VehicleLink> open(VehicleSetup setup);

  // Takes what came and says what there is to say. `running`: the controller is there.
  void turn(const fleet::vda5050::VehicleReading& reading, bool running,
            const fleet::vda5050::FleetOrders& orders, LinkNews& news);
  // The orderly end: the vehicle goes, and does so on purpose.
  void leave(LinkNews& news);

  const mqtt::Client& client() const { return client_; }

 private:
  using Clock = std::chrono::steady_clock;

  VehicleLink(VehicleSetup setup, fleet::vda5050::VehicleSide side, mqtt::Client client);
  void handle(const mqtt::Message& message, const fleet::vda5050::FleetOrders& orders, LinkNews& news);
  void say_connection(fleet::vda5050::ConnectionState state, LinkNews& news);
  void say_factsheet(LinkNews& news);
  void say_state(LinkNews& news);
  void say_place(const fleet::vda5050::VehicleReading& reading, LinkNews& news);

  VehicleSetup setup_;
  fleet::vda5050::VehicleSide side_;
  mqtt::Client client_;
  std::size_t connections_ = 0;  // of those, how many are greeted
  bool online_ = false;
  bool asked_ = false;  // for a state
  Clock::time_point state_at_{};
  Clock::time_point place_at_{};
  fleet::vda5050::VehicleReading shown_;
};

}  // namespace stepwright::vda5050_link
