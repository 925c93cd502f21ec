#include "cell/hall/hall.h"

#include <numbers>
#include <utility>

#include "runtime/ground/process/files.h"
#include "supervisor/ltl/scene/scene_reader.h"

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

result::Result<ltl::Floor> read_floor(const std::filesystem::path& scene) {
  auto text = process::read_file(scene.string());
  if (!text) return result::forward(text);
  return ltl::read_scene(*text, scene.string());
}

}  // namespace

result::Result<assemblies::TuggerParameters> hall_parameters(const config::PlantConfig& plant) {
  const config::TuggerPlantConfig& tugger = plant.tugger;
  auto floor = read_floor(tugger.scene);
  if (!floor) return result::forward(floor);
  assemblies::TuggerParameters parameters;
  parameters.links = {tugger.train.wheelbase_m, tugger.train.hitch_m, tugger.train.length_m,
                      tugger.train.width_m, tugger.train.spacing_m};
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
