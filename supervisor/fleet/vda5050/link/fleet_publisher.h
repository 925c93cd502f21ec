#pragma once

// Publishes the fleet of a running cell on a broker, as master control and as vehicles, from the data of
// controller and supervisor. It only reads them: if it dies, neither of them loses a scan.
//
// Plan document and image belong together only if the program in the image is the one that the document
// names. While they do not (a new plan is on its way), orders and progress stay as they are and only places,
// speeds and errors go on. So it is until each vehicle has been seen on the path of the plan. A new plan then
// gives updates to whose base it goes on from; the others' orders are cancelled, and new ones given as soon
// as their vehicles have confirmed that.
//
// One thread at a time; waits only in `turn`.
//
//   auto publisher = FleetPublisher::open(options);
//   while (!stop.came()) log((*publisher)->turn(watch.observe(), 50ms));

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/link/fleet_document.h"
#include "supervisor/fleet/vda5050/link/fleet_link.h"
#include "supervisor/fleet/vda5050/link/vehicle_image.h"
#include "supervisor/fleet/vda5050/link/vehicle_link.h"

namespace stepwright::vda5050_link {

// Present state of the cell.
struct CellView {
  bool runtime_alive = false;
  std::string controller;                              // why the program does not run; empty: it does
  std::shared_ptr<const reader::ProgramInfo> program;  // that `image` is of; null: not known yet
  std::string program_digest;
  std::vector<std::byte> image;
  std::string document;  // the newest plan document; empty: none yet
};

struct PublisherOptions {
  mqtt::Options broker;  // client id: those of the vehicles begin with it
  std::string interface_name = "uagv";
  std::string manufacturer = "Stepwright";
  std::string plan_name = "plan";  // order ids begin with it; of this run only
  std::string map_id = "floor";
  VehicleTimes times;
};

class FleetPublisher {
 public:
  // As mqtt::Client::open.
  [[nodiscard]] static result::Result<std::unique_ptr<FleetPublisher>> open(PublisherOptions options);

  // Takes what the cell shows, says what there is to say, and waits for messages at most so long.
  LinkNews turn(const CellView& view, std::chrono::milliseconds wait);
  // The vehicles say that they go.
  void leave();

  const mqtt::Client& client() const { return *client_; }
  std::size_t vehicles() const { return vehicles_.size(); }
  std::uint64_t revision() const { return fleet_ ? fleet_->revision : 0; }

 private:
  struct Vehicle {
    VehicleLink link;
    fleet::vda5050::VehicleReading reading;
  };

  FleetPublisher(PublisherOptions options, mqtt::Client client);
  void read_document(const CellView& view, LinkNews& news);
  std::optional<std::vector<VehicleImage>> images_of(const CellView& view, const FleetDocument& fleet);
  void meet(const std::vector<VehicleImage>& images, LinkNews& news);
  // True once the plan of `waiting_` is the one that orders are of.
  bool adopt(const std::vector<VehicleImage>& images, LinkNews& news);
  void show(const CellView& view, const std::vector<VehicleImage>& images, bool whole);
  // True once all vehicles of the plan were seen where the program says that they are.
  bool settled(const FleetDocument& fleet, const std::vector<VehicleImage>& images,
               const std::string& digest);
  fleet::vda5050::Places places_of(const FleetDocument& fleet, const std::vector<VehicleImage>& images) const;

  PublisherOptions options_;
  std::unique_ptr<mqtt::Client> client_;     // of the master control; at one place in memory
  std::string read_;                         // the document that `waiting_` or `fleet_` was read from
  std::string read_program_;                 // and the program beside it
  std::string digest_;                       // of the program that it names
  std::optional<FleetDocument> fleet_;       // orders are of its plan
  std::optional<FleetDocument> waiting_;     // comes next
  std::map<std::string, VehicleTags> tags_;  // by variable, of the program with `tags_digest_`
  std::string tags_digest_;
  std::string settled_;  // program and plan for which `settled` is true
  std::unique_ptr<FleetLink> link_;
  std::map<std::string, Vehicle> vehicles_;  // by serial number
};

}  // namespace stepwright::vda5050_link
