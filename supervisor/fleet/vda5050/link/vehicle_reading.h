#pragma once

// Reading of a vehicle, as the controller shows it, in the words of VDA 5050. Pure; any thread.
//
//   const auto reading = reading_of({.image = seen, .vehicle = entry, .mission = mission, ...});
//   side.show(reading);

#include <optional>
#include <string>
#include <utility>

#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/link/fleet_document.h"
#include "supervisor/fleet/vda5050/link/vehicle_image.h"
#include "supervisor/fleet/vda5050/vehicle_side.h"

namespace stepwright::vda5050_link {

// How near a vehicle comes to where it is told to be: nodes within it count as passed.
inline constexpr double kReach_m = 0.15;

struct Shown {
  const VehicleImage& image;
  const DocumentVehicle& vehicle;
  const fleet::VehicleMission& mission;
  const fleet::vda5050::FleetOrders& orders;
  std::string map_id;
  std::string controller;  // why the controller does not run; empty: it does
};

fleet::vda5050::VehicleReading reading_of(const Shown& shown);

// Polygons and way, within the bounds of the mission.
fleet::vda5050::VehicleLocation location_of(const VehicleImage& image, const fleet::VehicleMission& mission);

// Whether way and polygons can be those of the mission, with the vehicle where it is. After an online change
// the image shows those of the mission before for a scan.
bool plausible(const VehicleImage& image, const fleet::VehicleMission& mission);

// errorType and sentence of an ErrorID; of one that is not known, too.
std::pair<std::string, std::string> words_of_error(int error_id);

}  // namespace stepwright::vda5050_link
