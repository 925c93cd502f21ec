#include "cell/runtime/model_plant.h"

#include <chrono>
#include <string>
#include <utility>

#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"
#include "plant_models/core/names.h"
#include "runtime/host/plant_values.h"

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
  options.log = cell.plant.log;
  auto model = components::ModelPlant::load(cell.plant.file, components::library::catalogue(), options, kept);
  if (!model) return result::forward(model);
  return std::unique_ptr<core::Plant>(std::move(*model));
}

result::Diagnostics check_model(const config::CellConfig& cell) {
  const result::Location where{cell.plant.file.string(), 0, 0};
  const auto model = make_model(cell);
  if (!model) return {};
  result::Diagnostics problems = host::check_plant_values(core::names_of((*model)->truths()), where);
  constexpr auto kScan = std::chrono::milliseconds(10);
  for (int scan = 0; scan < 100 && !(*model)->failed(); ++scan) (void)(*model)->advance(kScan);
  if ((*model)->failed())
    problems.push_back({"C0351", result::Severity::Error, where, (*model)->trouble(), {}});
  return problems;
}

bool knows_model_wires(const config::PlantConfig& plant) {
  return components::read_model(plant.file, components::library::catalogue(), options_of(plant)).has_value();
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
