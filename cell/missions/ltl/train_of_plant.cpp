#include "cell/missions/ltl/train_of_plant.h"

#include <algorithm>

namespace stepwright::missions {
namespace {

bool is_simulated(const config::PlantConfig& plant) {
  return plant.kind == "tugger";
}

}  // namespace

ltl::TrainModel train_of(const config::PlantConfig& plant) {
  ltl::TrainModel train;
  if (!is_simulated(plant)) return train;
  const config::TuggerPlantConfig& tugger = plant.tugger;
  train.wheelbase_m = tugger.train.wheelbase_m;
  train.hitch_m = tugger.train.hitch_m;
  train.length_m = tugger.train.length_m;
  train.width_m = tugger.train.width_m;
  train.spacing_m = tugger.train.spacing_m;
  train.most_speed_m_s = tugger.drive.top_speed_m_s;
  train.most_acceleration_m_s2 = tugger.drive.acceleration_m_s2;
  train.most_lock_rad = tugger.steering.full_lock_rad;
  train.most_lock_rate_rad_s = tugger.steering.rate_rad_s;
  return train;
}

void keep_within(const config::PlantConfig& plant, ltl::TrainModel& train) {
  if (!is_simulated(plant)) return;
  const ltl::TrainModel simulated = train_of(plant);
  train.most_speed_m_s = std::min(train.most_speed_m_s, simulated.most_speed_m_s);
  train.most_acceleration_m_s2 = std::min(train.most_acceleration_m_s2, simulated.most_acceleration_m_s2);
  train.most_lock_rad = std::min(train.most_lock_rad, simulated.most_lock_rad);
  train.most_lock_rate_rad_s = std::min(train.most_lock_rate_rad_s, simulated.most_lock_rate_rad_s);
}

ltl::TrainDrive drive_of(const config::PlantConfig& plant, double top_speed_m_s) {
  ltl::TrainDrive drive;
  drive.top_speed_m_s = top_speed_m_s;
  if (!is_simulated(plant)) return drive;
  const config::TuggerDriveConfig& can = plant.tugger.drive;
  const config::TuggerSteeringConfig& steers = plant.tugger.steering;
  drive.top_speed_m_s = std::min(drive.top_speed_m_s, can.top_speed_m_s);
  drive.speed_up_m_s2 = std::min(drive.speed_up_m_s2, 0.5 * can.acceleration_m_s2);
  drive.brake_m_s2 = std::min(drive.brake_m_s2, 0.25 * can.braking_m_s2);
  drive.hard_brake_m_s2 = std::min(drive.hard_brake_m_s2, 0.5 * can.braking_m_s2);
  drive.lock_rate_rad_s = std::min(drive.lock_rate_rad_s, 0.5 * steers.rate_rad_s);
  drive.speed_lag_s = can.time_constant_s;
  drive.lock_lag_s = steers.time_constant_s;
  return drive;
}

}  // namespace stepwright::missions
