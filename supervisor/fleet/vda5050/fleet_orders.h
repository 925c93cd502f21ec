#pragma once

// The orders of a fleet: bases that reach up to the last node before a precedence that is not met yet, and
// grow as vehicles report what they have passed (supervisor/doc/vda5050.md).
//
// Invariants, as long as plans are Mode::Strict:
//  - Every message keeps the rules of check_message, every update those of check_update.
//  - A base is never shortened. Of two polygons of different vehicles that overlap at most one is within a
//  base
//    and not left yet.
// States are untrusted: one that contradicts the order is told and moves nothing.
//
// Which polygons have been left is known from the vehicles' states or, where one controller drives all
// vehicles and counts the polygons itself (Releases::ByController), from its image (`place`).
//
// One thread at a time. Time is passed in.
//
//   auto orders = FleetOrders::create(plan, {.plan_name = "shift7"});
//   for (const Order& order : orders->begin(now)) publish(order);
//   const Progress progress = orders->take(*read_state(payload, topic), now);
//   for (const Order& order : progress.orders) publish(order);

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/fleet/vda5050/order.h"
#include "supervisor/fleet/vda5050/route.h"
#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::fleet::vda5050 {

// What a vehicle itself complains of, in each of its states again.
inline constexpr const char* kVehicleComplains = "F0909";

enum class Releases : std::uint8_t {
  ByStates,      // a node that a vehicle reports
  ByController,  // polygons that the controller counts as left
};

// Where a vehicle is on the path of its mission, as the controller has it.
struct VehicleLocation {
  double arc_m = 0.0;
  std::uint32_t left = 0;  // polygons, from the first one
};
using Places = std::map<std::string, VehicleLocation>;  // by vehicle

struct OrderOptions {
  std::string plan_name = "plan";  // order ids begin with it: letters, digits and _ . : -
  std::string map_id = "floor";
  std::string interface_name = "uagv";
  std::string manufacturer = "Stepwright";     // serial numbers are the names of the vehicles
  std::set<std::string> charging_locations{};  // who parks there for good begins to charge
  RouteOptions route{};
  Releases releases = Releases::ByStates;
};

enum class Hold : std::uint8_t {
  Idle,        // no order
  Ordered,     // an order is sent
  Cancelling,  // cancelOrder is sent
};

struct Progress {
  std::vector<Order> orders;  // updates to send, of any vehicle
  result::Diagnostics
      wrong;  // F0907: what does not fit the order; F0909: what the vehicle complains of (warnings)
};

class FleetOrders {
 public:
  // F0906: a plan without a schedule, names that cannot be topics or ids, a vehicle twice.
  [[nodiscard]] static result::Result<FleetOrders> create(FleetPlan plan, OrderOptions options);
  FleetOrders(FleetOrders&&) noexcept;
  FleetOrders& operator=(FleetOrders&&) noexcept;
  ~FleetOrders();

  // The first order of each vehicle that has something to do, from where it is on its path. Once.
  std::vector<Order> begin(Timestamp now, const Places& places = {});

  // A vehicle's state: how far it is, which order it has accepted, whether it has cancelled.
  Progress take(const State& state, Timestamp now);

  // The controller's view: bases grow past what has been left. Requires Releases::ByController. F0907: it has
  // left what it was not to enter yet.
  Progress place(const Places& places, Timestamp now);

  // How many nodes of its order a vehicle has passed that is so far on the path of its mission, give or take
  // `reach_m`; 0 without an order.
  std::size_t passed(const std::string& vehicle, double arc_m, double reach_m) const;

  // Orders and updates that the last state of the vehicle did not know, oldest first, with new headers: QoS 0
  // loses messages. Send them again where the vehicle stays behind for longer than a message takes.
  std::vector<Order> unacknowledged(const std::string& vehicle, Timestamp now);

  // Whether this very order or update was sent to the vehicle that it names, its header aside.
  bool sent(const Order& order) const;

  Hold hold(const std::string& vehicle) const;
  // All of its order is passed and done.
  bool arrived(const std::string& vehicle) const;
  // The vehicle's order with all updates that were sent; nothing without an order.
  const Order* order(const std::string& vehicle) const;

  // Vehicles whose base another plan would change: a way that does not go on where the base leads, other work
  // on it, or a precedence in it that is not met. Their order has to be cancelled first.
  std::vector<std::string> affected(const FleetPlan& next, const Places& places = {}) const;

  // cancelOrder for a vehicle with an order. Until `adopt` no base grows, of any vehicle: where this one
  // comes to rest is not known. F0908 if it has none.
  [[nodiscard]] result::Result<InstantActions> cancel(const std::string& vehicle, Timestamp now);

  // The cancelOrder of a vehicle again, with the same id, while no state shows that it has come; nothing
  // else.
  std::optional<InstantActions> unconfirmed(const std::string& vehicle, Timestamp now);
  // The id of the cancelOrder that is under way; empty: none.
  std::string cancelling(const std::string& vehicle) const;

  // Goes on with another plan: new horizons for bases that stay, new orders for vehicles without one. F0908
  // if a vehicle is affected or still cancelling, if one with an order is missing, or if the path of a new
  // order does not begin where the vehicle stands. Nothing has changed then. `places` are on the paths of
  // `next`; with Releases::ByController orders begin there.
  [[nodiscard]] result::Result<std::vector<Order>> adopt(FleetPlan next, Timestamp now,
                                                         const Places& places = {});

  // startPause, stopPause, stateRequest, factsheetRequest and the like, without parameters. F0907 for a
  // vehicle that is in no plan.
  [[nodiscard]] result::Result<InstantActions> instant(const std::string& vehicle, const std::string& type,
                                                       Timestamp now);

 private:
  class Dispatch;
  explicit FleetOrders(std::unique_ptr<Dispatch> dispatch);

  std::unique_ptr<Dispatch> dispatch_;
};

}  // namespace stepwright::fleet::vda5050
