#include "cell/hall/hall.h"

#include <numbers>
#include <utility>

#include "runtime/ground/files/files.h"
#include "supervisor/ltl/scene/map_floor.h"
#include "supervisor/ltl/scene/scene_reader.h"
#include "supervisor/map/map_file.h"

namespace stepwright::cell_hall {
namespace {

body2d::Pose pose_of(const config::PlaceConfig& place) {
  return {{place.x_m, place.y_m}, place.heading_deg * std::numbers::pi / 180.0};
}

assemblies::FloorPolygon polygon_of(const ltl::Area& area) {
  assemblies::FloorPolygon polygon{area.name, {}};
  for (const geometry::Point corner : area.ring) polygon.ring.push_back({corner.x_m, corner.y_m});
  return polygon;
}

// Of the map the walls, and of the scene what stands and lies on its floor; or all of it of the scene.
result::Result<ltl::Floor> read_floor(const config::TuggerPlantConfig& tugger) {
  ltl::Floor floor;
  if (!tugger.map.empty()) {
    auto map = fleet::read_map(tugger.map);
    if (!map) return result::forward(map);
    floor = ltl::floor_of(*map, tugger.map.string());
    if (tugger.scene.empty()) return floor;
  }
  auto text = files::read_file(tugger.scene.string());
  if (!text) return result::forward(text);
  return ltl::read_scene(*text, tugger.scene.string(), std::move(floor),
                         tugger.map.empty() ? ltl::Border::InTheScene : ltl::Border::FromElsewhere);
}

void set_figures(const config::TuggerPlantConfig& tugger, assemblies::TuggerParameters& parameters) {
  parameters.links = {tugger.train.wheelbase_m, tugger.train.hitch_m, tugger.train.length_m,
                      tugger.train.width_m, tugger.train.spacing_m};
  const config::TuggerDriveConfig& drive = tugger.drive;
  parameters.drive = {drive.top_speed_m_s, drive.time_constant_s,   drive.acceleration_m_s2,
                      drive.braking_m_s2,  drive.spring_brake_m_s2, drive.tractor_kg,
                      drive.trailer_kg};
  parameters.steering = {tugger.steering.full_lock_rad, tugger.steering.time_constant_s,
                         tugger.steering.rate_rad_s};
  parameters.slip = {tugger.slip.drive_slip, tugger.slip.understeer_s2_m2, tugger.slip.hitch_slip_s2_m2};
  parameters.noise = {tugger.noise.position_m, tugger.noise.heading_rad, tugger.noise.speed_m_s,
                      tugger.noise.hitch_rad};
}

}  // namespace

result::Result<assemblies::TuggerParameters> hall_parameters(const config::PlantConfig& plant) {
  const config::TuggerPlantConfig& tugger = plant.tugger;
  auto floor = read_floor(tugger);
  if (!floor) return result::forward(floor);
  assemblies::TuggerParameters parameters;
  set_figures(tugger, parameters);
  parameters.trailers = tugger.trailers;
  parameters.most_trailers = tugger.most_trailers;
  parameters.start = pose_of(tugger.start);
  parameters.walls.push_back(polygon_of(floor->border));
  for (const ltl::Area& area : floor->obstacles) parameters.obstacles.push_back(polygon_of(area));
  for (const ltl::Area& area : floor->propositions) parameters.places.push_back(polygon_of(area));
  for (const config::BlockageConfig& blockage : tugger.blockages) {
    parameters.blockages.push_back(
        {"block_" + std::to_string(parameters.blockages.size() + 1),
         assemblies::rectangle_ring(pose_of(blockage.place), blockage.length_m, blockage.width_m)});
  }
  parameters.scanner_m = tugger.scanner_m;
  parameters.seed = plant.seed;
  if (!plant.uncertainty) parameters.noise = assemblies::TuggerNoise::none();
  return parameters;
}

std::vector<std::string> place_names(const assemblies::TuggerParameters& parameters) {
  std::vector<std::string> names;
  for (const assemblies::FloorPolygon& place : parameters.places) names.push_back(place.name);
  return names;
}

}  // namespace stepwright::cell_hall
