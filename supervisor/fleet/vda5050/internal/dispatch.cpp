#include "supervisor/fleet/vda5050/internal/dispatch.h"

#include <set>
#include <utility>

namespace stepwright::fleet::vda5050 {

namespace {

result::Diagnostic error(const char* code, const std::string& message, const std::string& hint = {}) {
  return {.code = code, .severity = result::Severity::Error, .where = {}, .message = message, .hint = hint};
}

// Of the end of its path: nothing is left to be ordered.
constexpr double kArrived_m = 0.15;

bool id_text(const std::string& text) {
  Address address;
  address.serial_number = text;
  return check(address).empty();
}

}  // namespace

result::Diagnostics FleetOrders::Dispatch::check_plan(const FleetPlan& plan, const OrderOptions& options) {
  result::Diagnostics wrong;
  if (plan.schedule.verdict != Verdict::Scheduled) {
    wrong.push_back(error("F0906", "the plan has no schedule", "only scheduled missions can be sent"));
  }
  if (!id_text(options.plan_name)) {
    wrong.push_back(error("F0906", "plan_name '" + options.plan_name + "' cannot be a part of ids",
                          "write letters, digits and _ . : - only"));
  }
  std::set<std::string> names;
  for (const VehicleMission& mission : plan.missions) {
    const Address address{options.interface_name, options.manufacturer, mission.vehicle};
    for (const result::Diagnostic& each : check(address)) wrong.push_back(each);
    if (!names.insert(mission.vehicle).second) {
      wrong.push_back(error("F0906", "two vehicles are called '" + mission.vehicle + "'"));
    }
  }
  return wrong;
}

void FleetOrders::Dispatch::meet() {
  index_.clear();
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    const std::string& name = plan_.missions[v].vehicle;
    index_[name] = static_cast<std::uint32_t>(v);
    vehicles_[name].address = {options_.interface_name, options_.manufacturer, name};
  }
}

// By states an order begins with the mission, by a controller with the last pose that is behind the vehicle.
std::optional<Order> FleetOrders::Dispatch::new_order(Vehicle& vehicle, std::size_t index, Timestamp now,
                                                      const Places& places) {
  const VehicleMission& mission = plan_.missions[index];
  if (!to_do(mission)) return std::nullopt;
  std::size_t from = 0;
  if (const auto at = places.find(mission.vehicle);
      options_.releases == Releases::ByController && at != places.end()) {
    while (from + 1 < mission.path.size() && mission.path[from + 1].arc_m <= at->second.arc_m) ++from;
    if (mission.path.back().arc_m - at->second.arc_m < kArrived_m) return std::nullopt;
  }
  const std::string id = options_.plan_name + "." + mission.vehicle + "." + std::to_string(++vehicle.orders);
  vehicle.order.emplace(id, options_, vehicle.charging);
  vehicle.order->lay(mission, route_of(mission, options_.route, from), 0);
  vehicle.order->release(clearances_.clear(static_cast<std::uint32_t>(index)));
  return vehicle.order->first(make_header(vehicle.address, Topic::Order, vehicle.ids, now));
}

std::vector<Order> FleetOrders::Dispatch::begin(Timestamp now, const Places& places) {
  for (const auto& [name, at] : places) {
    if (const auto index = index_.find(name); index != index_.end()) {
      clearances_.reached(index->second, at.left);
    }
  }
  std::vector<Order> orders;
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    Vehicle& vehicle = vehicles_[plan_.missions[v].vehicle];
    if (vehicle.order) continue;
    if (auto order = new_order(vehicle, v, now, places)) orders.push_back(*std::move(order));
  }
  return orders;
}

void FleetOrders::Dispatch::warn(const State& state, const std::string& source,
                                 result::Diagnostics& wrong) const {
  const auto add = [&](const std::string& message) {
    wrong.push_back({.code = kVehicleComplains,
                     .severity = result::Severity::Warning,
                     .where = {source, 0, 0},
                     .message = message,
                     .hint = {}});
  };
  if (state.mode != OperatingMode::Automatic && state.mode != OperatingMode::SemiAutomatic) {
    add("/operatingMode: the vehicle is not under control: it takes no orders and has dropped its own");
  }
  for (std::size_t k = 0; k < state.errors.size(); ++k) {
    const VehicleError& told = state.errors[k];
    add("/errors/" + std::to_string(k) + ": the vehicle reports " +
        (told.level == ErrorLevel::Fatal ? "the fatal error '" : "'") + told.type + "' " + told.description);
  }
  for (std::size_t k = 0; k < state.actions.size(); ++k) {
    if (state.actions[k].status != ActionStatus::Failed) continue;
    add("/actionStates/" + std::to_string(k) + ": '" + state.actions[k].id + "' has failed");
  }
}

Progress FleetOrders::Dispatch::take(const State& state, Timestamp now) {
  Progress progress;
  const std::string& name = state.header.serial_number;
  const std::string source = "state of " + name;
  const auto found = vehicles_.find(name);
  if (found == vehicles_.end() || state.header.manufacturer != options_.manufacturer) {
    progress.wrong.push_back(error("F0907", "/serialNumber: no vehicle of the plan is '" +
                                                state.header.manufacturer + " " + name + "'"));
    return progress;
  }
  Vehicle& vehicle = found->second;
  vehicle.position = state.position;
  vehicle.charging = state.battery.charging;
  warn(state, source, progress.wrong);
  if (!vehicle.cancel_id.empty()) {
    const auto cancelled = std::ranges::find(state.actions, vehicle.cancel_id, &ActionState::id);
    vehicle.cancel_came |= cancelled != state.actions.end();
    // Failed: it had no order to cancel.
    if (cancelled != state.actions.end() &&
        (cancelled->status == ActionStatus::Finished || cancelled->status == ActionStatus::Failed)) {
      vehicle.order.reset();
    }
    return progress;
  }
  if (!vehicle.order) return progress;
  auto reached = vehicle.order->take(state, source);
  if (!reached) {
    progress.wrong.insert(progress.wrong.end(), reached.error().begin(), reached.error().end());
    return progress;
  }
  if (!*reached || options_.releases == Releases::ByController) return progress;
  progress.orders = extend(clearances_.reached(index_.at(name), **reached), now);
  return progress;
}

std::vector<Order> FleetOrders::Dispatch::extend(const std::vector<std::uint32_t>& grown, Timestamp now) {
  std::vector<Order> orders;
  if (frozen()) return orders;
  for (const std::uint32_t other : grown) {
    Vehicle& next = vehicles_[plan_.missions[other].vehicle];
    if (!next.order || !next.order->release(clearances_.clear(other))) continue;
    orders.push_back(next.order->update(make_header(next.address, Topic::Order, next.ids, now)));
  }
  return orders;
}

Progress FleetOrders::Dispatch::place(const Places& places, Timestamp now) {
  std::vector<std::uint32_t> grown;
  for (const auto& [name, at] : places) {
    const auto index = index_.find(name);
    if (index == index_.end()) continue;
    for (const std::uint32_t other : clearances_.reached(index->second, at.left)) {
      if (std::ranges::find(grown, other) == grown.end()) grown.push_back(other);
    }
  }
  Progress progress{.orders = extend(grown, now), .wrong = {}};
  for (const auto& [name, at] : places) {
    const auto index = index_.find(name);
    if (index == index_.end() || clearances_.left(index->second) >= at.left) continue;
    progress.wrong.push_back(error("F0907",
                                   "'" + name + "' has left " + std::to_string(at.left) +
                                       " polygons and was to enter " +
                                       std::to_string(clearances_.clear(index->second)) + " only",
                                   "are plan and program of the same fleet?"));
  }
  return progress;
}

std::vector<Order> FleetOrders::Dispatch::unacknowledged(const std::string& name, Timestamp now) {
  std::vector<Order> orders;
  const auto found = vehicles_.find(name);
  if (found == vehicles_.end() || !found->second.order || !found->second.cancel_id.empty()) return orders;
  for (Order& order : found->second.order->pending()) {
    order.header = make_header(found->second.address, Topic::Order, found->second.ids, now);
    orders.push_back(order);
  }
  return orders;
}

InstantActions FleetOrders::Dispatch::instant(const std::string& name, const std::string& type,
                                              Timestamp now) {
  Vehicle& vehicle = vehicles_.at(name);
  const std::string id =
      options_.plan_name + "." + name + ".i" + std::to_string(++vehicle.instants) + "." + type;
  return {.header = make_header(vehicle.address, Topic::InstantActions, vehicle.ids, now),
          .actions = {{.type = type, .id = id, .blocking = Blocking::None, .parameters = {}}}};
}

InstantActions FleetOrders::Dispatch::cancel(const std::string& name, Timestamp now) {
  InstantActions message = instant(name, "cancelOrder", now);
  message.actions.front().blocking = Blocking::Hard;
  vehicles_.at(name).cancel_id = message.actions.front().id;
  vehicles_.at(name).cancel_came = false;
  return message;
}

std::optional<InstantActions> FleetOrders::Dispatch::unconfirmed(const std::string& name, Timestamp now) {
  const auto found = vehicles_.find(name);
  if (found == vehicles_.end()) return std::nullopt;
  Vehicle& vehicle = found->second;
  if (!vehicle.order || vehicle.cancel_id.empty() || vehicle.cancel_came) return std::nullopt;
  return InstantActions{
      .header = make_header(vehicle.address, Topic::InstantActions, vehicle.ids, now),
      .actions = {
          {.type = "cancelOrder", .id = vehicle.cancel_id, .blocking = Blocking::Hard, .parameters = {}}}};
}

}  // namespace stepwright::fleet::vda5050
