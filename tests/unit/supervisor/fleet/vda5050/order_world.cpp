#include "tests/unit/supervisor/fleet/vda5050/order_world.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/fleet/vda5050/stitching.h"
#include "supervisor/fleet/vda5050/write_message.h"

namespace stepwright::fleet::vda5050 {

namespace {

bool boxes_meet(const geometry::Box& a, const geometry::Box& b) {
  return a.low.x_m < b.high.x_m && b.low.x_m < a.high.x_m && a.low.y_m < b.high.y_m && b.low.y_m < a.high.y_m;
}

// The outline at every third pose of the path that the base leaves to the vehicle.
std::vector<geometry::ConvexPolygon> places(const VehicleMission& mission, const Order& order,
                                            std::optional<std::size_t> passed) {
  std::vector<geometry::ConvexPolygon> outlines;
  const auto footprint = mission.model.footprint();
  const auto nearest = [&](const Node& node) {
    std::size_t best = 0;
    double least = 1e9;
    for (std::size_t k = 0; k < mission.path.size(); ++k) {
      const double away =
          geometry::distance(mission.path[k].pose.position(), {node.position->x_m, node.position->y_m});
      const double turn = std::abs(
          std::remainder(mission.path[k].pose.heading_rad - *node.position->theta_rad, 6.283185307179586));
      if (away + turn >= least) continue;
      least = away + turn;
      best = k;
    }
    return best;
  };
  const std::size_t from = nearest(order.nodes[passed.value_or(0)]);
  const std::size_t to = nearest(order.nodes[*decision_point(order)]);
  for (std::size_t k = from; k < to; k += 3) {
    outlines.push_back(geometry::footprint_at(mission.path[k].pose, footprint));
  }
  outlines.push_back(geometry::footprint_at(mission.path[to].pose, footprint));
  return outlines;
}

}  // namespace

OrderWorld::OrderWorld(FleetPlan plan, OrderOptions options) : plan_(std::move(plan)) {
  auto made = FleetOrders::create(plan_, std::move(options));
  if (!made) throw std::runtime_error(to_string(made.error()));
  orders_.emplace(*std::move(made));
  for (const VehicleMission& mission : plan_.missions) {
    vehicles_.emplace(mission.vehicle, support::StandardVehicle("Stepwright", mission.vehicle));
  }
  for (const Order& order : orders_->begin(now_)) {
    first_[order.header.serial_number] = order;
    send(order, false);
  }
  judge_places();
}

void OrderWorld::lose(support::SplitMix64& random, double probability) {
  random_ = &random;
  probability_ = probability;
}

bool OrderWorld::lost() {
  return random_ != nullptr && random_->between(0.0, 1.0) < probability_;
}

void OrderWorld::send(const Order& order, bool again) {
  now_ += std::chrono::seconds(1);
  const std::string& name = order.header.serial_number;
  const std::string text = to_json(order);
  for (const auto& wrong : check_message(Topic::Order, text, name)) fault(to_string(wrong));
  const auto read = read_order(text, name);
  if (!read || *read != order) fault("the order of " + name + " is read as another one");
  const auto held = held_.find(name);
  if (!again && held != held_.end() && held->second.order_id == order.order_id) {
    for (const auto& wrong : check_update(held->second, order, name)) fault(to_string(wrong));
    held->second = stitched(held->second, order);
    ++updates_;
    ++updates_of_[name];
  } else if (!again) {
    held_[name] = order;
  }
  if (lost()) return;
  const std::string refused = vehicles_.at(name).take_order(text);
  // An update whose predecessor was lost is refused, and repeated in order later.
  if (!refused.empty() && random_ == nullptr) fault(name + ": " + refused);
}

void OrderWorld::tell(const std::string& name, bool charging) {
  now_ += std::chrono::seconds(1);
  State state = vehicles_.at(name).state(now_);
  state.battery.charging = charging;
  const std::string text = to_json(state);
  if (lost()) return;
  const auto read = read_state(text, name);
  if (!read) return fault(to_string(read.error()));
  const Progress progress = orders_->take(*read, now_);
  for (const auto& wrong : progress.wrong) {
    if (wrong.severity == result::Severity::Error) fault(to_string(wrong));
  }
  for (const Order& order : progress.orders) send(order, false);
  if (!progress.orders.empty()) judge_places();
}

bool OrderWorld::drive(const std::string& name, bool charging) {
  const bool moved = vehicles_.at(name).drive();
  tell(name, charging);
  return moved;
}

void OrderWorld::repeat(const std::string& name) {
  for (const Order& order : orders_->unacknowledged(name, now_)) send(order, true);
}

void OrderWorld::cancel(const std::string& name) {
  const auto message = orders_->cancel(name, now_);
  if (!message) return fault(to_string(message.error()));
  vehicles_.at(name).take_instant_actions(to_json(*message));
  tell(name, false);
}

std::vector<Order> OrderWorld::adopt(FleetPlan next) {
  auto orders = orders_->adopt(next, now_);
  if (!orders) {
    fault(to_string(orders.error()));
    return {};
  }
  plan_ = std::move(next);
  for (const Order& order : *orders) send(order, false);
  judge_places();
  return *std::move(orders);
}

// Whatever vehicles do within what they were told, their outlines never meet: those between the last node
// that a vehicle has reported and the end of its base.
void OrderWorld::judge_places() {
  std::vector<std::vector<geometry::ConvexPolygon>> all;
  for (const VehicleMission& mission : plan_.missions) {
    const Order* const order = orders_->order(mission.vehicle);
    const auto& vehicle = vehicles_.at(mission.vehicle);
    if (order == nullptr) {
      all.push_back({geometry::footprint_at(mission.path.front().pose, mission.model.footprint())});
    } else {
      const bool has_it = vehicle.order() && vehicle.order()->order_id == order->order_id;
      all.push_back(places(mission, *order, has_it ? vehicle.passed() : std::nullopt));
    }
  }
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      for (const auto& x : all[a]) {
        for (const auto& y : all[b]) {
          if (!boxes_meet(x.bounds(), y.bounds()) || !geometry::overlaps(x, y)) continue;
          return fault(plan_.missions[a].vehicle + " and " + plan_.missions[b].vehicle + " may meet");
        }
      }
    }
  }
}

std::size_t OrderWorld::updates(const std::string& name) const {
  const auto found = updates_of_.find(name);
  return found == updates_of_.end() ? 0 : found->second;
}

bool OrderWorld::all_arrived() const {
  for (const VehicleMission& mission : plan_.missions) {
    if (!orders_->arrived(mission.vehicle)) return false;
  }
  return true;
}

}  // namespace stepwright::fleet::vda5050
