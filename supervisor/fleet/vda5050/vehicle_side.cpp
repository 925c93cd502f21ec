#include "supervisor/fleet/vda5050/vehicle_side.h"

#include <algorithm>
#include <utility>

#include "supervisor/fleet/vda5050/stitching.h"

namespace stepwright::fleet::vda5050 {

namespace {

std::vector<std::pair<std::string, std::string>> references_to(const Order& order) {
  return {{"topic", "order"},
          {"headerId", std::to_string(order.header.header_id)},
          {"orderId", order.order_id},
          {"orderUpdateId", std::to_string(order.update_id)}};
}

VehicleError warning(const char* type, std::string description,
                     std::vector<std::pair<std::string, std::string>> references) {
  return {.type = type,
          .level = ErrorLevel::Warning,
          .description = std::move(description),
          .references = std::move(references)};
}

}  // namespace

void VehicleSide::refuse(VehicleError error, Timestamp now) {
  // What comes again and again is one error.
  std::erase_if(refusals_, [&](const Refusal& other) {
    return other.error.type == error.type && other.error.description == error.description;
  });
  if (refusals_.size() == kMostRefusals) refusals_.pop_front();
  refusals_.push_back({std::move(error), now});
}

void VehicleSide::refuse(Topic topic, const result::Diagnostics& wrong, Timestamp now) {
  const std::string what = wrong.empty() ? "the message breaks the rules" : wrong.front().message;
  refuse(warning("validationError", what, {{"topic", std::string(to_string(topic))}}), now);
}

void VehicleSide::take(const Order& order, Sender sender, Timestamp now) {
  if (sender == Sender::Stranger) {
    return refuse(
        warning("orderError", "the vehicle drives by the plan of its cell and takes orders of nobody else",
                references_to(order)),
        now);
  }
  if (order_ && order.order_id == order_->order_id) {
    if (order.update_id <= update_id_) return;  // it came twice
    // An update whose predecessor was lost; both come again.
    if (!check_update(*order_, order, {}).empty()) return;
    order_ = stitched(*std::move(order_), order);
  } else {
    if (order.update_id != 0) return;  // its first message was lost
    order_ = order;
    progress_ = {};
    std::erase_if(refusals_, [](const Refusal& refusal) { return refusal.error.type == "orderError"; });
  }
  order_id_ = order.order_id;
  update_id_ = order.update_id;
}

void VehicleSide::answer(const Action& action, ActionStatus status, const std::string& result) {
  if (instants_.size() == kMostInstantActions) instants_.pop_front();
  instants_.push_back({.id = action.id, .type = action.type, .status = status, .result = result});
}

void VehicleSide::refuse_action(const Action& action, const Header& header, const std::string& why,
                                Timestamp now) {
  answer(action, ActionStatus::Failed, why);
  const bool idle = action.type == "cancelOrder" && !order_;
  refuse(warning(idle ? "noOrderToCancel" : "instantActionError", "'" + action.type + "': " + why,
                 {{"topic", "instantActions"},
                  {"headerId", std::to_string(header.header_id)},
                  {"actionId", action.id},
                  {"actionType", action.type}}),
         now);
}

RequestedMessages VehicleSide::take(const InstantActions& message, const std::string& cancel_id,
                                    Timestamp now) {
  RequestedMessages requested{.state = true, .factsheet = false};
  for (const Action& action : message.actions) {
    if (const auto known = std::ranges::find(instants_, action.id, &ActionState::id);
        known != instants_.end()) {
      std::rotate(known, known + 1, instants_.end());  // it came again: the answer stays for longer
      continue;
    }
    if (action.type == "stateRequest") {
      answer(action, ActionStatus::Finished, {});
    } else if (action.type == "factsheetRequest") {
      requested.factsheet = true;
      answer(action, ActionStatus::Finished, {});
    } else if (action.type == "cancelOrder" && !order_) {
      refuse_action(action, message.header, "the vehicle has no order", now);
    } else if (action.type == "cancelOrder" && !cancel_id.empty() && action.id == cancel_id) {
      order_.reset();
      answer(action, ActionStatus::Finished, {});
    } else if (action.type == "cancelOrder" || action.type == "startPause" || action.type == "stopPause") {
      refuse_action(action, message.header,
                    "the controller of the cell keeps to its plan; only its operators can change that", now);
    } else {
      refuse_action(action, message.header, "the vehicle does not know this action", now);
    }
  }
  return requested;
}

void VehicleSide::show(VehicleReading reading) {
  reading_ = std::move(reading);
  if (!order_ || reading_.order_id != order_->order_id) return;
  progress_ = {reading_.passed, reading_.unfinished, reading_.action_failed};
}

std::size_t VehicleSide::passed() const {
  return order_ ? std::min(progress_.passed, decision_point(*order_).value_or(0) + 1) : 0;
}

std::vector<ActionState> VehicleSide::order_actions() const {
  std::vector<ActionState> all;
  if (!order_) return all;
  const std::size_t behind = passed();
  std::size_t last_end = 0;  // behind the actions of the last node passed that has some
  for (std::size_t k = 0; k < order_->nodes.size(); ++k) {
    for (const Action& action : order_->nodes[k].actions) {
      const auto status = k < behind ? ActionStatus::Finished : ActionStatus::Waiting;
      all.push_back({.id = action.id, .type = action.type, .status = status, .result = {}});
    }
    if (k < behind && !order_->nodes[k].actions.empty()) last_end = all.size();
  }
  std::size_t first = last_end;
  while (first > 0 && first > last_end - std::min(last_end, progress_.unfinished)) {
    all[--first].status = ActionStatus::Waiting;
  }
  if (first < last_end) {
    all[first].status = progress_.action_failed ? ActionStatus::Failed : ActionStatus::Running;
  }
  return all;
}

State VehicleSide::contents() const {
  State state;
  state.order_id = order_id_;
  state.update_id = update_id_;
  state.driving = reading_.driving;
  state.position = reading_.position;
  state.velocity = reading_.velocity;
  state.loads = reading_.loads;
  state.emergency_stop = reading_.emergency_stop;
  state.field_violation = reading_.field_violation;
  state.errors = reading_.errors;
  for (const Refusal& refusal : refusals_) state.errors.push_back(refusal.error);
  state.actions = order_actions();
  state.actions.insert(state.actions.end(), instants_.begin(), instants_.end());
  state.last_node = last_node_;
  state.last_node_sequence = last_sequence_;
  if (!order_) return state;
  const std::size_t behind = passed();
  if (behind > 0) {
    state.last_node = order_->nodes[behind - 1].id;
    state.last_node_sequence = order_->nodes[behind - 1].sequence;
  }
  for (std::size_t k = behind; k < order_->nodes.size(); ++k) {
    const Node& node = order_->nodes[k];
    state.nodes.push_back({node.id, node.sequence, node.released});
  }
  for (std::size_t k = behind == 0 ? 0 : behind - 1; k < order_->edges.size(); ++k) {
    const Edge& edge = order_->edges[k];
    state.edges.push_back({edge.id, edge.sequence, edge.released});
  }
  // At the end of its base with more ahead: it waits for somebody.
  state.new_base_request = behind == decision_point(*order_).value_or(0) + 1 && behind < order_->nodes.size();
  return state;
}

void VehicleSide::forget_refusals(Timestamp now) {
  std::erase_if(refusals_, [&](const Refusal& refusal) { return now - refusal.since > kRefusalStays; });
}

bool VehicleSide::has_news(Timestamp now) {
  forget_refusals(now);
  State next = contents();
  next.position.reset();
  next.velocity.reset();
  return !said_ || *said_ != next;
}

State VehicleSide::state(Timestamp now) {
  forget_refusals(now);
  State state = contents();
  last_node_ = state.last_node;
  last_sequence_ = state.last_node_sequence;
  said_ = state;
  said_->position.reset();
  said_->velocity.reset();
  state.header = make_header(address_, Topic::State, ids_, now);
  return state;
}

Visualization VehicleSide::visualization(Timestamp now) {
  return {.header = make_header(address_, Topic::Visualization, ids_, now),
          .position = reading_.position,
          .velocity = reading_.velocity};
}

Connection VehicleSide::connection(ConnectionState connection, Timestamp now) {
  return {.header = make_header(address_, Topic::Connection, ids_, now), .state = connection};
}

Header VehicleSide::factsheet_header(Timestamp now) {
  return make_header(address_, Topic::Factsheet, ids_, now);
}

}  // namespace stepwright::fleet::vda5050
