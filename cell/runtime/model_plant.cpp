#include "cell/runtime/model_plant.h"

#include <utility>

#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"

namespace stepwright::cell_runtime {
namespace {

components::ModelOptions options_of(const config::PlantConfig& plant) {
  return {.seed = plant.seed, .uncertainty = plant.uncertainty};
}

}  // namespace

result::Result<std::unique_ptr<core::Plant>> make_model(const config::CellConfig& cell,
                                                        const std::optional<std::vector<double>>& left) {
  std::optional<std::span<const double>> kept;
  if (left) kept = *left;
  components::ModelOptions options = options_of(cell.plant);
  options.processes = cell.state_dir / "fmu";
  auto model = components::ModelPlant::load(cell.plant.file, components::library::catalogue(), options, kept);
  if (!model) return result::forward(model);
  return std::unique_ptr<core::Plant>(std::move(*model));
}

std::vector<bridge::PortWire> model_wires(const config::PlantConfig& plant) {
  std::vector<bridge::PortWire> wires;
  auto text = components::read_model(plant.file, components::library::catalogue(), options_of(plant));
  if (!text) return wires;
  for (const components::TerminalText& terminal : text->terminals)
    wires.push_back({terminal.name, terminal.address, terminal.where});
  return wires;
}

}  // namespace stepwright::cell_runtime
