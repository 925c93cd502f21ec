#include "cell/runtime/tugger_plant.h"

#include <string>

#include "cell/hall/hall.h"
#include "plant_models/assemblies/tugger_floor.h"
#include "plant_models/assemblies/tugger_train.h"

namespace stepwright::cell_runtime {

result::Result<assemblies::TuggerParameters> tugger_parameters(const config::PlantConfig& plant) {
  auto parameters = cell_hall::hall_parameters(plant);
  if (!parameters) return result::forward(parameters);
  auto train = assemblies::TuggerTrain::create(*parameters);
  if (!train) {
    // Figures have passed the configuration's ranges: it is about outlines of the scene, or of the map.
    const std::filesystem::path& hall = plant.tugger.scene.empty() ? plant.tugger.map : plant.tugger.scene;
    for (result::Diagnostic& problem : train.error()) {
      if (problem.where.file.empty()) problem.where.file = hall.string();
    }
    return result::forward(train);
  }
  const assemblies::TuggerFloor floor(*parameters);
  const auto boxes = (*train)->boxes();
  for (std::size_t link = 0; link < boxes.size(); ++link) {
    if (!floor.in_a_wall(boxes[link])) continue;
    const std::string name = link == 0 ? "the tractor" : "trailer " + std::to_string(link);
    return result::fail("C0322", plant.tugger.start.where,
                        name + " stands in a wall, in an obstacle or outside of the hall",
                        "all links stand in one line behind the tractor");
  }
  return parameters;
}

std::vector<bridge::PortWire> tugger_wires(const config::PlantConfig& plant) {
  const auto parameters = cell_hall::hall_parameters(plant);
  if (!parameters) return {};
  return bridge::default_tugger_wires(assemblies::most_trailers(*parameters),
                                      cell_hall::place_names(*parameters));
}

}  // namespace stepwright::cell_runtime
