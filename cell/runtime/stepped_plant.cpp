#include "cell/runtime/stepped_plant.h"

#include <string>
#include <utility>
#include <vector>

#include "plant_models/fmu/fmu_call.h"
#include "plant_models/stepped/installed_peer.h"

namespace stepwright::cell_runtime {
namespace {

std::vector<stepped::SteppedTerminal> terminals_of(const std::vector<config::SteppedTerminalConfig>& list) {
  std::vector<stepped::SteppedTerminal> terminals;
  for (const config::SteppedTerminalConfig& each : list) {
    terminals.push_back({each.name, each.is_switch ? core::PortKind::Bool : core::PortKind::Count,
                         each.at_zero, each.per_count, each.unit, each.meaning});
  }
  return terminals;
}

std::vector<core::Quantity> quantities_of(const std::vector<config::SteppedQuantityConfig>& list) {
  std::vector<core::Quantity> quantities;
  for (const config::SteppedQuantityConfig& each : list) quantities.push_back({each.name, each.unit, {}});
  return quantities;
}

std::vector<core::FaultRange> ranges_of(const std::vector<config::SteppedQuantityConfig>& faults) {
  std::vector<core::FaultRange> ranges;
  for (const config::SteppedQuantityConfig& each : faults) ranges.push_back({each.low, each.high, false});
  return ranges;
}

std::vector<std::string> call_of(const config::CellConfig& cell) {
  const config::SteppedPlantConfig& config = cell.plant.stepped;
  if (cell.plant.kind == "shared") return config.command;
  std::vector<std::pair<std::string, double>> parameters;
  for (const config::SteppedParameterConfig& each : config.parameters)
    parameters.emplace_back(each.name, each.value);
  if (cell.plant.kind == "fmu") return fmu::fmu_call({config.file, cell.state_dir / "fmu", parameters});
  std::vector<std::string> call = stepped::installed_peer(cell.plant.kind, parameters);
  call.emplace_back("--");
  for (const std::filesystem::path& source : config.sources)
    call.push_back(std::filesystem::absolute(source).string());
  return call;
}

// How its process is started: the person's own command, or the one of this installation that runs an FMU or a
// program in ST.
stepped::StepCommand command_of(const config::CellConfig& cell) {
  const config::SteppedPlantConfig& config = cell.plant.stepped;
  stepped::StepCommand command;
  command.arguments = call_of(cell);
  command.folder = config.folder;
  command.patience = config.patience;
  command.beginning = config.beginning;
  command.log = cell.plant.log;
  command.where = config.where;
  return command;
}

}  // namespace

std::unique_ptr<stepped::SteppedPlant> stepped_plant(const config::CellConfig& cell) {
  const config::SteppedPlantConfig& config = cell.plant.stepped;
  return std::make_unique<stepped::SteppedPlant>(
      stepped::SteppedDescription{cell.plant.kind, terminals_of(config.actuators),
                                  terminals_of(config.sensors), quantities_of(config.values),
                                  quantities_of(config.faults), ranges_of(config.faults), config.step,
                                  cell.plant.seed},
      command_of(cell));
}

}  // namespace stepwright::cell_runtime
