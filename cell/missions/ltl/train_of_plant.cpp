#include "cell/missions/ltl/train_of_plant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace stepwright::missions {
namespace {

bool is_simulated(const config::PlantConfig& plant) {
  return plant.kind == "tugger";
}

constexpr double kSameSize_m = 1e-9;

struct SizeOfBoth {
  const char* key;
  double simulated_m;
  double planned_m;
};

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

result::Result<void> check_agrees(const config::PlantConfig& plant, const ltl::TrainModel& train) {
  if (!is_simulated(plant)) return {};
  const config::TuggerPlantConfig& tugger = plant.tugger;
  result::Diagnostics wrong;
  const auto refuse = [&](result::Location where, std::string message, std::string hint) {
    wrong.push_back(
        {"L0504", result::Severity::Error, std::move(where), std::move(message), std::move(hint)});
  };
  const SizeOfBoth sizes[] = {{"wheelbase_m", tugger.train.wheelbase_m, train.wheelbase_m},
                              {"hitch_m", tugger.train.hitch_m, train.hitch_m},
                              {"length_m", tugger.train.length_m, train.length_m},
                              {"width_m", tugger.train.width_m, train.width_m},
                              {"spacing_m", tugger.train.spacing_m, train.spacing_m}};
  for (const auto& [key, simulated_m, planned_m] : sizes) {
    if (std::abs(simulated_m - planned_m) <= kSameSize_m) continue;
    const auto where = tugger.train.where.find(key);
    refuse(where != tugger.train.where.end() ? where->second : result::Location{},
           fmt::format("{} of the simulated train is {}, and {} of the problem's train", key, simulated_m,
                       planned_m),
           fmt::format("without {} in the problem's train it is the simulated one's", key));
  }
  if (train.trailers > tugger.most_trailers)
    refuse(tugger.most_where,
           fmt::format("the problem's train has {} trailers, the simulated one {} at most", train.trailers,
                       tugger.most_trailers),
           fmt::format("most_trailers = {} in [plant], or fewer trailers in the problem", train.trailers));
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return {};
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
