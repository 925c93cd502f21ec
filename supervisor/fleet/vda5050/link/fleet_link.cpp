#include "supervisor/fleet/vda5050/link/fleet_link.h"

#include <algorithm>
#include <utility>

#include "supervisor/fleet/vda5050/link/checked_publish.h"
#include "supervisor/fleet/vda5050/link/utc_now.h"
#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/fleet/vda5050/write_message.h"

namespace stepwright::vda5050_link {

using namespace fleet::vda5050;

namespace {

void append(result::Diagnostics& all, const result::Diagnostics& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Nobody speaks for another vehicle.
bool speaks_for_itself(const Header& header, const Address& address, LinkNews& news,
                       const std::string& topic) {
  if (header.manufacturer == address.manufacturer && header.serial_number == address.serial_number)
    return true;
  append(news.wrong, result::fail("F0907", {topic, 0, 0},
                                  "/serialNumber: '" + header.manufacturer + " " + header.serial_number +
                                      "' is not whose topic this is")
                         .value());
  return false;
}

}  // namespace

FleetLink::FleetLink(FleetOrders orders, std::set<std::string> vehicles, mqtt::Client& client,
                     LinkOptions options)
    : orders_(std::move(orders)),
      vehicles_(std::move(vehicles)),
      client_(client),
      options_(std::move(options)) {
  for (const Topic topic : {Topic::State, Topic::Connection}) {
    const std::string all =
        options_.interface_name + "/v2/" + options_.manufacturer + "/+/" + std::string(to_string(topic));
    client_.subscribe(all, delivery_of(topic).qos);
  }
}

void FleetLink::publish(const Order& order, LinkNews& news) {
  const Address address{options_.interface_name, options_.manufacturer, order.header.serial_number};
  // What cannot be handed over now is not acknowledged either, and repeated.
  publish_checked(client_, address, Topic::Order, to_json(order), news.wrong);
  sent_[order.header.serial_number] = std::chrono::steady_clock::now();
  ++published_;
}

void FleetLink::publish(const InstantActions& actions, LinkNews& news) {
  const Address address{options_.interface_name, options_.manufacturer, actions.header.serial_number};
  publish_checked(client_, address, Topic::InstantActions, to_json(actions), news.wrong);
  ++published_;
}

void FleetLink::take_state(const mqtt::Message& message, const Address& address, LinkNews& news) {
  const auto state = read_state(message.payload, message.topic);
  if (!state) return append(news.wrong, state.error());
  if (!speaks_for_itself(state->header, address, news, message.topic)) return;
  const Progress progress = orders_.take(*state, utc_now());
  append(news.wrong, progress.wrong);
  for (const Order& order : progress.orders) publish(order, news);
}

void FleetLink::take_connection(const mqtt::Message& message, const Address& address, LinkNews& news) {
  const auto connection = read_connection(message.payload, message.topic);
  if (!connection) return append(news.wrong, connection.error());
  if (!speaks_for_itself(connection->header, address, news, message.topic)) return;
  // A vehicle that has come back is told once more what it may have missed.
  if (const auto cancel = cancels_.find(address.serial_number);
      connection->state == ConnectionState::Online && cancel != cancels_.end()) {
    cancel->second.attempts = 0;
  }
  auto& list = connection->state == ConnectionState::Online ? news.online : news.lost;
  list.push_back(address.serial_number);
}

void FleetLink::handle(const mqtt::Message& message, LinkNews& news) {
  const auto topic = parse_topic_name(message.topic);
  if (!topic) return;
  if (topic->topic == Topic::State) take_state(message, topic->address, news);
  if (topic->topic == Topic::Connection) take_connection(message, topic->address, news);
}

void FleetLink::repeat(LinkNews& news) {
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [name, sent] : std::map(sent_)) {
    if (now - sent < options_.resend) continue;
    for (const Order& order : orders_.unacknowledged(name, utc_now())) {
      publish(order, news);
      ++repeated_;
    }
  }
  repeat_cancels(news);
}

void FleetLink::repeat_cancels(LinkNews& news) {
  const auto now = std::chrono::steady_clock::now();
  std::erase_if(cancels_, [&](const auto& each) { return orders_.hold(each.first) != Hold::Cancelling; });
  for (auto& [name, cancel] : cancels_) {
    if (now - cancel.sent < options_.resend || cancel.attempts > options_.cancel_attempts) continue;
    const auto message = orders_.unconfirmed(name, utc_now());
    if (!message) continue;  // the vehicle has it and is busy with it
    cancel.sent = now;
    if (++cancel.attempts > options_.cancel_attempts) {
      append(news.wrong,
             result::fail("F0910", {},
                          "'" + name + "' has not answered cancelOrder, sent " +
                              std::to_string(options_.cancel_attempts) + " times",
                          "is the vehicle connected? No base grows until its state shows the action")
                 .value());
      continue;
    }
    publish(*message, news);
    ++repeated_;
  }
}

LinkNews FleetLink::turn(std::chrono::milliseconds wait) {
  LinkNews news = std::exchange(later_, {});
  if (!begun_ && client_.connected()) {
    begun_ = true;
    for (const Order& order : orders_.begin(utc_now(), places_)) publish(order, news);
  }
  for (const mqtt::Message& message : client_.take(wait)) handle(message, news);
  if (client_.connected()) repeat(news);
  return news;
}

LinkNews FleetLink::place(const Places& places) {
  LinkNews news;
  places_ = places;
  if (!begun_) return news;
  Progress progress = orders_.place(places, utc_now());
  append(news.wrong, progress.wrong);
  for (const Order& order : progress.orders) publish(order, news);
  return news;
}

result::Result<void> FleetLink::cancel(const std::string& vehicle) {
  if (orders_.hold(vehicle) == Hold::Cancelling) return {};
  const auto message = orders_.cancel(vehicle, utc_now());
  if (!message) return tl::unexpected(message.error());
  cancels_[vehicle] = {std::chrono::steady_clock::now(), 1};
  publish(*message, later_);
  return {};
}

result::Result<void> FleetLink::adopt(fleet::FleetPlan next, const Places& places) {
  const auto orders = orders_.adopt(std::move(next), utc_now(), places);
  if (!orders) return tl::unexpected(orders.error());
  places_ = places;
  for (const Order& order : *orders) publish(order, later_);
  return {};
}

bool FleetLink::all_arrived() const {
  return std::ranges::all_of(vehicles_, [&](const std::string& name) { return orders_.arrived(name); });
}

}  // namespace stepwright::vda5050_link
