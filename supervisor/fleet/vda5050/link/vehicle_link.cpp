#include "supervisor/fleet/vda5050/link/vehicle_link.h"

#include <utility>

#include "supervisor/fleet/vda5050/link/checked_publish.h"
#include "supervisor/fleet/vda5050/link/utc_now.h"
#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/fleet/vda5050/write_message.h"

namespace stepwright::vda5050_link {

using namespace fleet::vda5050;

namespace {

// What comes in and is not looked at in time is dropped beyond this.
constexpr std::size_t kMostWaiting = 256;

}  // namespace

VehicleLink::VehicleLink(VehicleSetup setup, VehicleSide side, mqtt::Client client)
    : setup_(std::move(setup)), side_(std::move(side)), client_(std::move(client)) {
  for (const Topic topic : {Topic::Order, Topic::InstantActions}) {
    client_.subscribe(topic_name(setup_.address, topic), delivery_of(topic).qos);
  }
}

result::Result<VehicleLink> VehicleLink::open(VehicleSetup setup) {
  VehicleSide side(setup.address);
  const Delivery delivery = delivery_of(Topic::Connection);
  mqtt::Options options = setup.broker;
  options.client_id += "-" + setup.address.serial_number;
  options.most_waiting = kMostWaiting;
  options.will = mqtt::Will{.topic = topic_name(setup.address, Topic::Connection),
                            .payload = to_json(side.connection(ConnectionState::Broken, utc_now())),
                            .qos = delivery.qos,
                            .retained = delivery.retained};
  auto client = mqtt::Client::open(options);
  if (!client) return result::forward(client);
  return VehicleLink(std::move(setup), std::move(side), *std::move(client));
}

void VehicleLink::say_connection(ConnectionState state, LinkNews& news) {
  const std::string text = to_json(side_.connection(state, utc_now()));
  publish_checked(client_, setup_.address, Topic::Connection, text, news.wrong);
  online_ = state == ConnectionState::Online;
}

void VehicleLink::say_factsheet(LinkNews& news) {
  setup_.sheet.header = side_.factsheet_header(utc_now());
  publish_checked(client_, setup_.address, Topic::Factsheet, to_json(setup_.sheet), news.wrong);
}

void VehicleLink::say_state(LinkNews& news) {
  publish_checked(client_, setup_.address, Topic::State, to_json(side_.state(utc_now())), news.wrong);
  state_at_ = Clock::now();
  asked_ = false;
}

void VehicleLink::say_place(const VehicleReading& reading, LinkNews& news) {
  const bool moved = reading.position != shown_.position || reading.velocity != shown_.velocity;
  if (!moved || Clock::now() - place_at_ < setup_.times.visualization) return;
  shown_ = reading;
  place_at_ = Clock::now();
  const std::string text = to_json(side_.visualization(utc_now()));
  publish_checked(client_, setup_.address, Topic::Visualization, text, news.wrong);
}

void VehicleLink::handle(const mqtt::Message& message, const FleetOrders& orders, LinkNews& news) {
  const auto topic = parse_topic_name(message.topic);
  if (!topic) return;
  const auto refuse = [&](const result::Diagnostics& wrong) {
    side_.refuse(topic->topic, wrong, utc_now());
    // A stranger's fault, not ours.
    for (result::Diagnostic each : wrong) {
      each.severity = result::Severity::Warning;
      news.wrong.push_back(std::move(each));
    }
  };
  if (topic->topic == Topic::Order) {
    auto order = read_order(message.payload, message.topic);
    if (!order) return refuse(order.error());
    order->header.serial_number = setup_.address.serial_number;
    side_.take(*order, orders.sent(*order) ? Sender::Control : Sender::Stranger, utc_now());
  } else if (topic->topic == Topic::InstantActions) {
    const auto actions = read_instant_actions(message.payload, message.topic);
    if (!actions) return refuse(actions.error());
    const RequestedMessages requested =
        side_.take(*actions, orders.cancelling(setup_.address.serial_number), utc_now());
    if (requested.factsheet) say_factsheet(news);
    asked_ |= requested.state;
  }
}

void VehicleLink::turn(const VehicleReading& reading, bool running, const FleetOrders& orders,
                       LinkNews& news) {
  if (!client_.connected()) return;
  side_.show(reading);
  if (const std::size_t made = client_.connections(); made != connections_) {
    connections_ = made;
    say_connection(running ? ConnectionState::Online : ConnectionState::Offline, news);
    say_factsheet(news);
    asked_ = true;
  } else if (running != online_) {
    say_connection(running ? ConnectionState::Online : ConnectionState::Offline, news);
    asked_ = true;
  }
  for (const mqtt::Message& message : client_.take(std::chrono::milliseconds(0))) {
    handle(message, orders, news);
  }
  if (!running) return;
  const auto since = Clock::now() - state_at_;
  const bool due = since >= setup_.times.state_every;
  if (due || asked_ || (since >= setup_.times.state_least && side_.has_news(utc_now()))) say_state(news);
  say_place(reading, news);
}

void VehicleLink::leave(LinkNews& news) {
  if (client_.connected()) say_connection(ConnectionState::Offline, news);
}

}  // namespace stepwright::vda5050_link
