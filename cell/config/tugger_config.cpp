#include "cell/config/tugger_config.h"

#include <utility>

namespace stepwright::config {
namespace {

using settings::Range;
using settings::TomlTable;

constexpr Range kFigure{0.01, 100.0};
constexpr Range kTrailers{0, 15};
constexpr Range kSpeed_m_s{0.05, 20.0};
constexpr Range kTime_s{0.01, 30.0};
constexpr Range kChange_m_s2{0.01, 50.0};
constexpr Range kTractor_kg{1.0, 100'000.0};
constexpr Range kTrailer_kg{0.0, 100'000.0};
constexpr Range kLock_rad{0.05, 1.45};
constexpr Range kRate_rad_s{0.01, 50.0};
constexpr Range kSlip{0.0, 0.9};
constexpr Range kSlip_s2_m2{0.0, 1.0};
constexpr Range kNoise{0.0, 1.0};

TrainConfig read_train(const TomlTable& table) {
  TrainConfig train;
  const std::pair<const char*, double*> figures[] = {{"wheelbase_m", &train.wheelbase_m},
                                                     {"hitch_m", &train.hitch_m},
                                                     {"length_m", &train.length_m},
                                                     {"width_m", &train.width_m},
                                                     {"spacing_m", &train.spacing_m}};
  for (const auto& [key, figure] : figures) {
    *figure = table.number(key, *figure, kFigure);
    train.where[key] = table.where(key);
  }
  return train;
}

TuggerDriveConfig read_drive(const TomlTable& table) {
  TuggerDriveConfig drive;
  drive.top_speed_m_s = table.number("top_speed_m_s", drive.top_speed_m_s, kSpeed_m_s);
  drive.time_constant_s = table.number("time_constant_s", drive.time_constant_s, kTime_s);
  drive.acceleration_m_s2 = table.number("acceleration_m_s2", drive.acceleration_m_s2, kChange_m_s2);
  drive.braking_m_s2 = table.number("braking_m_s2", drive.braking_m_s2, kChange_m_s2);
  drive.spring_brake_m_s2 = table.number("spring_brake_m_s2", drive.spring_brake_m_s2, kChange_m_s2);
  drive.tractor_kg = table.number("tractor_kg", drive.tractor_kg, kTractor_kg);
  drive.trailer_kg = table.number("trailer_kg", drive.trailer_kg, kTrailer_kg);
  return drive;
}

TuggerSteeringConfig read_steering(const TomlTable& table) {
  TuggerSteeringConfig steering;
  steering.full_lock_rad = table.number("full_lock_rad", steering.full_lock_rad, kLock_rad);
  steering.time_constant_s = table.number("time_constant_s", steering.time_constant_s, kTime_s);
  steering.rate_rad_s = table.number("rate_rad_s", steering.rate_rad_s, kRate_rad_s);
  return steering;
}

TuggerSlipConfig read_slip(const TomlTable& table) {
  TuggerSlipConfig slip;
  slip.drive_slip = table.number("drive_slip", slip.drive_slip, kSlip);
  slip.understeer_s2_m2 = table.number("understeer_s2_m2", slip.understeer_s2_m2, kSlip_s2_m2);
  slip.hitch_slip_s2_m2 = table.number("hitch_slip_s2_m2", slip.hitch_slip_s2_m2, kSlip_s2_m2);
  return slip;
}

TuggerNoiseConfig read_noise(const TomlTable& table) {
  TuggerNoiseConfig noise;
  noise.position_m = table.number("position_m", noise.position_m, kNoise);
  noise.heading_rad = table.number("heading_rad", noise.heading_rad, kNoise);
  noise.speed_m_s = table.number("speed_m_s", noise.speed_m_s, kNoise);
  noise.hitch_rad = table.number("hitch_rad", noise.hitch_rad, kNoise);
  return noise;
}

// A floor of polygons, of a map, or both.
void read_hall(const TomlTable& plant, const std::filesystem::path& folder, TuggerPlantConfig& tugger) {
  tugger.scene = read_plant_file(plant, "scene", folder);
  tugger.map = read_plant_file(plant, "map", folder);
  const std::string ending = tugger.scene.extension().string();
  if (ending == ".yaml" || ending == ".yml")
    plant.report("scene", "a ROS map is no scene", "map = \"map.yaml\"; the scene beside it has its places");
  if (!plant.has("scene") && !plant.has("map"))
    plant.report("kind", "a tugger train without a hall",
                 "scene = \"hall.geojson\", with its polygons, or map = \"map.yaml\"");
}

}  // namespace

TuggerPlantConfig read_tugger_plant(const TomlTable& plant, const std::filesystem::path& folder) {
  TuggerPlantConfig tugger;
  read_hall(plant, folder, tugger);
  tugger.trailers = static_cast<std::size_t>(plant.integer("trailers", 5, kTrailers));
  const auto as_many = static_cast<std::int64_t>(tugger.trailers);
  tugger.most_trailers = static_cast<std::size_t>(plant.integer("most_trailers", as_many, kTrailers));
  tugger.most_where = plant.where(plant.has("most_trailers") ? "most_trailers" : "trailers");
  if (tugger.most_trailers < tugger.trailers)
    plant.report("most_trailers", "less than the trailers that are coupled at the start");
  tugger.scanner_m = plant.number("scanner_m", tugger.scanner_m, {0.1, 100.0});
  if (plant.has("start"))
    tugger.start = read_place(plant.table("start"));
  else
    plant.report("kind", "a tugger train that stands nowhere", "[plant.start] with x_m, y_m and heading_deg");
  tugger.train = read_train(plant.table("train"));
  tugger.drive = read_drive(plant.table("drive"));
  tugger.steering = read_steering(plant.table("steering"));
  tugger.slip = read_slip(plant.table("slip"));
  tugger.noise = read_noise(plant.table("noise"));
  for (const TomlTable& table : plant.tables("blockages")) tugger.blockages.push_back(read_blockage(table));
  return tugger;
}

}  // namespace stepwright::config
