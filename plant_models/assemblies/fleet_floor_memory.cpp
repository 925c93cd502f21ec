// What outlives the process that simulates the floor: numbers in the order of keep().

#include <cmath>

#include "plant_models/assemblies/fleet_floor.h"

namespace stepwright::assemblies {
namespace {

constexpr std::size_t kPerVehicle = 4;  // pose, height of the forks
constexpr std::size_t kPerPallet = 4;   // pose, number of its carrier (0 = none)

bool is_pose(std::span<const double> numbers) {
  return std::abs(numbers[0]) <= 2.0 * kFarthest_m && std::abs(numbers[1]) <= 2.0 * kFarthest_m &&
         std::isfinite(numbers[2]);
}

}  // namespace

std::size_t FleetFloor::kept_size() const {
  return kPerVehicle * vehicles_.size() + kPerPallet * pallets_.size();
}

void FleetFloor::keep(std::span<double> numbers) const {
  std::size_t at = 0;
  for (const Vehicle& vehicle : vehicles_) {
    const ForkliftPose pose = vehicle.forklift->pose();
    for (const double number : {pose.x_m, pose.y_m, pose.heading_rad, vehicle.lift_travel})
      numbers[at++] = number;
  }
  for (const Pallet& pallet : pallets_) {
    const body2d::Pose pose = world_.pose(pallet.body);
    const double carrier = pallet.carrier ? static_cast<double>(*pallet.carrier + 1) : 0.0;
    for (const double number : {pose.position.x, pose.position.y, pose.angle, carrier})
      numbers[at++] = number;
  }
}

bool FleetFloor::resume(std::span<const double> numbers) {
  if (numbers.size() != kept_size()) return false;
  const auto vehicle_numbers = [&](std::size_t i) { return numbers.subspan(kPerVehicle * i, kPerVehicle); };
  const auto pallet_numbers = [&](std::size_t i) {
    return numbers.subspan(kPerVehicle * vehicles_.size() + kPerPallet * i, kPerPallet);
  };
  std::vector<bool> carries(vehicles_.size() + 1, false);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const auto kept = vehicle_numbers(i);
    if (!is_pose(kept) || !(kept[3] >= 0.0 && kept[3] <= 1.0)) return false;
  }
  for (std::size_t i = 0; i < pallets_.size(); ++i) {
    const auto kept = pallet_numbers(i);
    const double carrier = kept[3];
    if (!is_pose(kept) || !(carrier >= 0.0 && carrier < static_cast<double>(carries.size())) ||
        carrier != std::floor(carrier)) {
      return false;
    }
    const auto by = static_cast<std::size_t>(carrier);
    if (by != 0 && (carries[by] || vehicle_numbers(by - 1)[3] < 0.5)) return false;
    carries[by] = true;
  }
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const auto kept = vehicle_numbers(i);
    vehicles_[i].forklift->stop_at({kept[0], kept[1], kept[2]});
    vehicles_[i].lift_travel = kept[3];
    vehicles_[i].lift = kept[3] >= 0.5;
    world_.place(vehicles_[i].body, chassis_pose(vehicles_[i].forklift->pose()), {});
  }
  for (std::size_t i = 0; i < pallets_.size(); ++i) {
    const auto kept = pallet_numbers(i);
    world_.place(pallets_[i].body, {{kept[0], kept[1]}, kept[2]}, {});
    if (kept[3] != 0.0) take(static_cast<std::size_t>(kept[3]) - 1, i);
  }
  return true;
}

}  // namespace stepwright::assemblies
