#include "tests/support/vda5050/standard_vehicle.h"

#include <utility>

#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/geometry/point.h"

namespace stepwright::support {

using namespace fleet::vda5050;

StandardVehicle::StandardVehicle(std::string manufacturer, std::string serial_number)
    : manufacturer_(std::move(manufacturer)), serial_number_(std::move(serial_number)) {}

std::size_t StandardVehicle::decision() const {
  std::size_t last = 0;
  while (last + 1 < order_->nodes.size() && order_->nodes[last + 1].released) ++last;
  return last;
}

bool StandardVehicle::idle() const {
  return !order_ || (passed_ && *passed_ + 1 == order_->nodes.size());
}

std::string StandardVehicle::take_order(const std::string& text) {
  const auto order = read_order(text, "order");
  std::string refused;
  if (!order) {
    refused = "validationError: " + to_string(order.error());
  } else {
    refused = order->order_id == order_id_ && order_ ? take_update(*order) : take_new(*order);
  }
  errors_.clear();
  if (!refused.empty()) {
    errors_.push_back({refused.substr(0, refused.find(':')), ErrorLevel::Warning, refused, {}});
  }
  return refused;
}

std::string StandardVehicle::take_new(const Order& order) {
  if (!idle()) return "orderError: still busy with " + order_id_;
  const NodePosition& first = *order.nodes.front().position;
  if (position_ && geometry::distance({position_->x_m, position_->y_m}, {first.x_m, first.y_m}) >
                       first.deviation_xy_m.value_or(0.0)) {
    return "orderError: the first node is out of reach";
  }
  order_ = order;
  order_id_ = order.order_id;
  update_id_ = order.update_id;
  passed_.reset();
  actions_.clear();
  return {};
}

std::string StandardVehicle::take_update(const Order& update) {
  if (update.update_id == update_id_) return {};  // twice
  if (update.update_id < update_id_) return "orderUpdateError: old";
  const std::size_t end = decision();
  if (update.nodes.front().id != order_->nodes[end].id ||
      update.nodes.front().sequence != order_->nodes[end].sequence) {
    return "orderUpdateError: does not continue the base";
  }
  order_->nodes.resize(end + 1);
  order_->edges.resize(end);
  order_->nodes.insert(order_->nodes.end(), update.nodes.begin() + 1, update.nodes.end());
  order_->edges.insert(order_->edges.end(), update.edges.begin(), update.edges.end());
  update_id_ = update.update_id;
  return {};
}

void StandardVehicle::take_instant_actions(const std::string& text) {
  const auto message = read_instant_actions(text, "instantActions");
  if (!message) return;
  for (const Action& action : message->actions) {
    ActionState done{action.id, action.type, ActionStatus::Finished, {}};
    if (action.type == "cancelOrder") {
      if (!order_) done.status = ActionStatus::Failed;
      order_.reset();
      passed_.reset();
    }
    actions_.push_back(done);
  }
}

bool StandardVehicle::drive() {
  if (!order_) return false;
  const std::size_t next = passed_ ? *passed_ + 1 : 0;
  if (next > decision() || !order_->nodes[next].released) return false;
  const Node& node = order_->nodes[next];
  passed_ = next;
  last_node_ = node.id;
  last_sequence_ = node.sequence;
  position_ = AgvPosition{node.position->x_m, node.position->y_m, node.position->theta_rad.value_or(0.0),
                          node.position->map_id, true};
  for (const Action& action : node.actions) {
    actions_.push_back({action.id, action.type, ActionStatus::Finished, {}});
  }
  return true;
}

State StandardVehicle::state(Timestamp now) {
  State state;
  state.header = make_header({"uagv", manufacturer_, serial_number_}, Topic::State, ids_, now);
  state.order_id = order_id_;
  state.update_id = update_id_;
  state.last_node = last_node_;
  state.last_node_sequence = last_sequence_;
  state.position = position_;
  state.actions = actions_;
  state.errors = errors_;
  if (!order_) return state;
  const std::size_t next = passed_ ? *passed_ + 1 : 0;
  for (std::size_t k = next; k < order_->nodes.size(); ++k) {
    state.nodes.push_back({order_->nodes[k].id, order_->nodes[k].sequence, order_->nodes[k].released});
  }
  for (std::size_t k = passed_.value_or(0); k < order_->edges.size(); ++k) {
    state.edges.push_back({order_->edges[k].id, order_->edges[k].sequence, order_->edges[k].released});
  }
  return state;
}

}  // namespace stepwright::support
