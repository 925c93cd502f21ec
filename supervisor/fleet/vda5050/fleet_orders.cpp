#include "supervisor/fleet/vda5050/fleet_orders.h"

#include <utility>

#include "supervisor/fleet/vda5050/internal/dispatch.h"

namespace stepwright::fleet::vda5050 {

FleetOrders::FleetOrders(std::unique_ptr<Dispatch> dispatch) : dispatch_(std::move(dispatch)) {}
FleetOrders::FleetOrders(FleetOrders&&) noexcept = default;
FleetOrders& FleetOrders::operator=(FleetOrders&&) noexcept = default;
FleetOrders::~FleetOrders() = default;

result::Result<FleetOrders> FleetOrders::create(FleetPlan plan, OrderOptions options) {
  auto wrong = Dispatch::check_plan(plan, options);
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return FleetOrders(std::make_unique<Dispatch>(std::move(plan), std::move(options)));
}

std::vector<Order> FleetOrders::begin(Timestamp now, const Places& places) {
  return dispatch_->begin(now, places);
}

Progress FleetOrders::take(const State& state, Timestamp now) {
  return dispatch_->take(state, now);
}

Progress FleetOrders::place(const Places& places, Timestamp now) {
  return dispatch_->place(places, now);
}

std::size_t FleetOrders::passed(const std::string& vehicle, double arc_m, double reach_m) const {
  const Dispatch::Vehicle* const found = dispatch_->find(vehicle);
  return found != nullptr && found->order ? found->order->passed(arc_m, reach_m) : 0;
}

std::vector<Order> FleetOrders::unacknowledged(const std::string& vehicle, Timestamp now) {
  return dispatch_->unacknowledged(vehicle, now);
}

bool FleetOrders::sent(const Order& order) const {
  const Dispatch::Vehicle* const found = dispatch_->find(order.header.serial_number);
  return found != nullptr && found->order && found->order->sent(order);
}

Hold FleetOrders::hold(const std::string& vehicle) const {
  const Dispatch::Vehicle* const found = dispatch_->find(vehicle);
  if (found == nullptr || !found->order) return Hold::Idle;
  return found->cancel_id.empty() ? Hold::Ordered : Hold::Cancelling;
}

bool FleetOrders::arrived(const std::string& vehicle) const {
  const Dispatch::Vehicle* const found = dispatch_->find(vehicle);
  return found != nullptr && found->order && found->order->done();
}

const Order* FleetOrders::order(const std::string& vehicle) const {
  const Dispatch::Vehicle* const found = dispatch_->find(vehicle);
  return found != nullptr && found->order ? &found->order->whole() : nullptr;
}

std::vector<std::string> FleetOrders::affected(const FleetPlan& next, const Places& places) const {
  return dispatch_->affected(next, places);
}

result::Result<InstantActions> FleetOrders::cancel(const std::string& vehicle, Timestamp now) {
  if (hold(vehicle) == Hold::Idle) {
    return result::fail("F0908", {}, "'" + vehicle + "' has no order that could be cancelled");
  }
  return dispatch_->cancel(vehicle, now);
}

std::optional<InstantActions> FleetOrders::unconfirmed(const std::string& vehicle, Timestamp now) {
  return dispatch_->unconfirmed(vehicle, now);
}

std::string FleetOrders::cancelling(const std::string& vehicle) const {
  const Dispatch::Vehicle* const found = dispatch_->find(vehicle);
  return found != nullptr && found->order ? found->cancel_id : std::string();
}

result::Result<std::vector<Order>> FleetOrders::adopt(FleetPlan next, Timestamp now, const Places& places) {
  auto wrong = Dispatch::check_plan(next, dispatch_->options());
  if (wrong.empty()) wrong = dispatch_->hindrances(next, places);
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return dispatch_->adopt(std::move(next), now, places);
}

result::Result<InstantActions> FleetOrders::instant(const std::string& vehicle, const std::string& type,
                                                    Timestamp now) {
  if (dispatch_->find(vehicle) == nullptr) {
    return result::fail("F0907", {}, "no vehicle of the plan is called '" + vehicle + "'");
  }
  return dispatch_->instant(vehicle, type, now);
}

}  // namespace stepwright::fleet::vda5050
