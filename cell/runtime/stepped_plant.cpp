#include "cell/runtime/stepped_plant.h"

#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace

result::Result<std::unique_ptr<stepped::SteppedPlant>> stepped_plant(const config::PlantConfig& plant) {
  const config::SteppedPlantConfig& config = plant.stepped;
  return std::make_unique<stepped::SteppedPlant>(stepped::SteppedDescription{
      plant.kind, terminals_of(config.actuators), terminals_of(config.sensors), quantities_of(config.values),
      quantities_of(config.faults), ranges_of(config.faults), config.step, plant.seed});
}

stepped::StepCommand stepped_command(const config::CellConfig& cell) {
  const config::SteppedPlantConfig& config = cell.plant.stepped;
  stepped::StepCommand command;
  command.folder = config.folder;
  command.patience = config.patience;
  command.beginning = config.beginning;
  command.where = config.where;
  if (cell.plant.kind == "shared") {
    command.arguments = config.command;
    return command;
  }
  const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string kind = "plant-" + cell.plant.kind;
  command.arguments = {(programs / ("stepwright-" + kind)).string(), kind};
  for (const config::SteppedParameterConfig& each : config.parameters) {
    std::array<char, 40> number{};
    std::snprintf(number.data(), number.size(), "%.17g", each.value);
    command.arguments.insert(command.arguments.end(), {"--parameter", each.name, number.data()});
  }
  if (cell.plant.kind == "fmu") {
    command.arguments.insert(command.arguments.end(),
                             {"--folder", std::filesystem::absolute(cell.state_dir / "fmu").string(), "--",
                              std::filesystem::absolute(config.file).string()});
    return command;
  }
  command.arguments.emplace_back("--");
  for (const std::filesystem::path& source : config.sources)
    command.arguments.push_back(std::filesystem::absolute(source).string());
  return command;
}

}  // namespace stepwright::cell_runtime
