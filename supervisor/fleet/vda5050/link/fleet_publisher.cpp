#include "supervisor/fleet/vda5050/link/fleet_publisher.h"

#include <algorithm>
#include <set>
#include <thread>
#include <utility>

#include "supervisor/fleet/vda5050/link/vehicle_reading.h"

namespace stepwright::vda5050_link {

using namespace fleet::vda5050;

namespace {

void append(LinkNews& all, LinkNews more) {
  const auto move_to = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move_to(all.wrong, more.wrong);
  move_to(all.online, more.online);
  move_to(all.lost, more.lost);
}

std::set<std::string> serial_numbers(const FleetDocument& fleet) {
  std::set<std::string> names;
  for (const DocumentVehicle& vehicle : fleet.vehicles) names.insert(vehicle.serial_number);
  return names;
}

Factsheet sheet_of(const VehicleImage& seen) {
  const VehicleData data = data_of(seen);
  VehicleType type;
  type.acceleration_mps2 = seen.acceleration_mps2;
  type.deceleration_mps2 = seen.deceleration_mps2;
  return factsheet_of(data.model, {.min_mps = 0.0, .max_mps = data.max_mps}, {}, type);
}

}  // namespace

FleetPublisher::FleetPublisher(PublisherOptions options, mqtt::Client client)
    : options_(std::move(options)), client_(std::make_unique<mqtt::Client>(std::move(client))) {}

result::Result<std::unique_ptr<FleetPublisher>> FleetPublisher::open(PublisherOptions options) {
  auto client = mqtt::Client::open(options.broker);
  if (!client) return result::forward(client);
  return std::unique_ptr<FleetPublisher>(new FleetPublisher(std::move(options), *std::move(client)));
}

std::optional<std::vector<VehicleImage>> FleetPublisher::images_of(const CellView& view,
                                                                   const FleetDocument& fleet) {
  if (!view.program) return std::nullopt;
  if (tags_digest_ != view.program_digest) tags_.clear();
  tags_digest_ = view.program_digest;
  std::vector<VehicleImage> images;
  for (const DocumentVehicle& vehicle : fleet.vehicles) {
    auto known = tags_.find(vehicle.variable);
    if (known == tags_.end()) {
      const auto tags = VehicleTags::find(*view.program, vehicle.variable);
      if (!tags) return std::nullopt;
      known = tags_.emplace(vehicle.variable, *tags).first;
    }
    images.push_back(known->second.read(view.image));
  }
  return images;
}

// Outlines and speeds come out of the image: a document is read beside the program that it names.
void FleetPublisher::read_document(const CellView& view, LinkNews& news) {
  if (view.document.empty() || !view.program) return;
  if (view.document == read_ && view.program_digest == read_program_) return;
  read_ = view.document;
  read_program_ = view.program_digest;
  const auto data = [&](const std::string& variable) {
    const auto tags = VehicleTags::find(*view.program, variable);
    return tags ? data_of(tags->read(view.image)) : VehicleData{};
  };
  auto document = read_plan_document(view.document, "plan document", data);
  if (!document) {
    news.wrong.insert(news.wrong.end(), document.error().begin(), document.error().end());
    return;
  }
  digest_ = document->program_digest;
  if (!document->fleet || document->fleet->plan.schedule.verdict != fleet::Verdict::Scheduled) return;
  if (fleet_ && document->fleet->revision == fleet_->revision) {
    fleet_->vehicles = std::move(document->fleet->vehicles);  // states and stops; the plan is the same
    waiting_.reset();
  } else {
    waiting_ = std::move(document->fleet);
  }
}

bool FleetPublisher::settled(const FleetDocument& fleet, const std::vector<VehicleImage>& images,
                             const std::string& digest) {
  const std::string key = digest + "/" + std::to_string(fleet.revision);
  if (settled_ == key) return true;
  for (std::size_t v = 0; v < images.size(); ++v) {
    if (!plausible(images[v], fleet.plan.missions[v])) return false;
  }
  settled_ = key;
  return true;
}

Places FleetPublisher::places_of(const FleetDocument& fleet, const std::vector<VehicleImage>& images) const {
  Places places;
  for (std::size_t v = 0; v < images.size(); ++v) {
    places[fleet.vehicles[v].serial_number] = location_of(images[v], fleet.plan.missions[v]);
  }
  return places;
}

// Master control and vehicles of a fleet that is seen for the first time.
void FleetPublisher::meet(const std::vector<VehicleImage>& images, LinkNews& news) {
  leave();
  link_.reset();
  vehicles_.clear();
  fleet_.reset();
  const auto refuse = [&](const result::Diagnostics& wrong) {
    news.wrong.insert(news.wrong.end(), wrong.begin(), wrong.end());
    waiting_.reset();
  };
  auto orders = FleetOrders::create(waiting_->plan, {.plan_name = options_.plan_name,
                                                     .map_id = options_.map_id,
                                                     .interface_name = options_.interface_name,
                                                     .manufacturer = options_.manufacturer,
                                                     .releases = Releases::ByController});
  if (!orders) return refuse(orders.error());
  for (std::size_t v = 0; v < images.size(); ++v) {
    const std::string& name = waiting_->vehicles[v].serial_number;
    auto link = VehicleLink::open({.address = {options_.interface_name, options_.manufacturer, name},
                                   .broker = options_.broker,
                                   .sheet = sheet_of(images[v]),
                                   .times = options_.times});
    if (!link) return refuse(link.error());
    vehicles_.emplace(name, Vehicle{*std::move(link), {}});
  }
  link_ = std::make_unique<FleetLink>(
      *std::move(orders), serial_numbers(*waiting_), *client_,
      LinkOptions{.interface_name = options_.interface_name, .manufacturer = options_.manufacturer});
  fleet_ = std::exchange(waiting_, std::nullopt);
}

bool FleetPublisher::adopt(const std::vector<VehicleImage>& images, LinkNews& news) {
  const bool same = fleet_ && serial_numbers(*fleet_) == serial_numbers(*waiting_);
  if (!link_ || !same) {
    meet(images, news);
    return fleet_.has_value();
  }
  // Without a broker nobody could confirm anything; the newest plan waits.
  if (!client_->connected()) return false;
  const Places places = places_of(*waiting_, images);
  for (const std::string& name : link_->orders().affected(waiting_->plan, places)) {
    if (auto good = link_->cancel(name); !good) {
      news.wrong.insert(news.wrong.end(), good.error().begin(), good.error().end());
    }
  }
  for (const DocumentVehicle& vehicle : waiting_->vehicles) {
    if (link_->orders().hold(vehicle.serial_number) == Hold::Cancelling) return false;
  }
  if (auto good = link_->adopt(waiting_->plan, places); !good) {
    news.wrong.insert(news.wrong.end(), good.error().begin(), good.error().end());
    waiting_.reset();
    return false;
  }
  fleet_ = std::exchange(waiting_, std::nullopt);
  return true;
}

// `whole`: the image is of the plan that orders are of; else only what does not depend on it is taken.
void FleetPublisher::show(const CellView& view, const std::vector<VehicleImage>& images, bool whole) {
  for (std::size_t v = 0; v < images.size() && v < fleet_->vehicles.size(); ++v) {
    const auto found = vehicles_.find(fleet_->vehicles[v].serial_number);
    if (found == vehicles_.end()) continue;
    VehicleReading& reading = found->second.reading;
    VehicleReading next = reading_of({.image = images[v],
                                      .vehicle = fleet_->vehicles[v],
                                      .mission = fleet_->plan.missions[v],
                                      .orders = link_->orders(),
                                      .map_id = options_.map_id,
                                      .controller = view.controller});
    if (!whole) next.order_id.clear();
    reading = std::move(next);
  }
}

LinkNews FleetPublisher::turn(const CellView& view, std::chrono::milliseconds wait) {
  LinkNews news;
  read_document(view, news);
  const bool fits = digest_.empty() || digest_ == view.program_digest;
  if (waiting_ && fits) {
    const auto images = images_of(view, *waiting_);
    if (images && settled(*waiting_, *images, view.program_digest)) adopt(*images, news);
  }
  if (!link_) {
    std::this_thread::sleep_for(wait);
    return news;
  }
  const auto images = images_of(view, *fleet_);
  if (images) {
    const bool whole = fits && !waiting_ && settled(*fleet_, *images, view.program_digest);
    if (whole) append(news, link_->place(places_of(*fleet_, *images)));
    show(view, *images, whole);
  }
  append(news, link_->turn(wait));
  for (auto& [name, vehicle] : vehicles_) {
    vehicle.link.turn(vehicle.reading, view.runtime_alive, link_->orders(), news);
  }
  return news;
}

void FleetPublisher::leave() {
  LinkNews news;
  for (auto& [name, vehicle] : vehicles_) vehicle.link.leave(news);
}

}  // namespace stepwright::vda5050_link
