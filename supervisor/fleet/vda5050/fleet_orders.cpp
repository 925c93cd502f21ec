#include "supervisor/fleet/vda5050/fleet_orders.h"

#include <utility>

#include "supervisor/fleet/vda5050/internal/desk.h"

namespace stepwright::fleet::vda5050 {

FleetOrders::FleetOrders(std::unique_ptr<Desk> desk) : desk_(std::move(desk)) {}
FleetOrders::FleetOrders(FleetOrders&&) noexcept = default;
FleetOrders& FleetOrders::operator=(FleetOrders&&) noexcept = default;
FleetOrders::~FleetOrders() = default;

result::Result<FleetOrders> FleetOrders::create(FleetPlan plan, OrderOptions options) {
  auto wrong = Desk::check_plan(plan, options);
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return FleetOrders(std::make_unique<Desk>(std::move(plan), std::move(options)));
}

std::vector<Order> FleetOrders::begin(Timestamp now) {
  return desk_->begin(now);
}

Progress FleetOrders::take(const State& state, Timestamp now) {
  return desk_->take(state, now);
}

std::vector<Order> FleetOrders::unacknowledged(const std::string& vehicle, Timestamp now) {
  return desk_->unacknowledged(vehicle, now);
}

Hold FleetOrders::hold(const std::string& vehicle) const {
  const Desk::Vehicle* const found = desk_->find(vehicle);
  if (found == nullptr || !found->order) return Hold::Idle;
  return found->cancel_id.empty() ? Hold::Ordered : Hold::Cancelling;
}

bool FleetOrders::arrived(const std::string& vehicle) const {
  const Desk::Vehicle* const found = desk_->find(vehicle);
  return found != nullptr && found->order && found->order->done();
}

const Order* FleetOrders::order(const std::string& vehicle) const {
  const Desk::Vehicle* const found = desk_->find(vehicle);
  return found != nullptr && found->order ? &found->order->whole() : nullptr;
}

std::vector<std::string> FleetOrders::affected(const FleetPlan& next) const {
  return desk_->affected(next);
}

result::Result<InstantActions> FleetOrders::cancel(const std::string& vehicle, Timestamp now) {
  if (hold(vehicle) == Hold::Idle) {
    return result::fail("F0908", {}, "'" + vehicle + "' has no order that could be cancelled");
  }
  return desk_->cancel(vehicle, now);
}

result::Result<std::vector<Order>> FleetOrders::adopt(FleetPlan next, Timestamp now) {
  auto wrong = Desk::check_plan(next, desk_->options());
  if (wrong.empty()) wrong = desk_->hindrances(next);
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return desk_->adopt(std::move(next), now);
}

result::Result<InstantActions> FleetOrders::instant(const std::string& vehicle, const std::string& type,
                                                    Timestamp now) {
  if (desk_->find(vehicle) == nullptr) {
    return result::fail("F0907", {}, "no vehicle of the plan is called '" + vehicle + "'");
  }
  return desk_->instant(vehicle, type, now);
}

}  // namespace stepwright::fleet::vda5050
