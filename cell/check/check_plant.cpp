#include "cell/check/check_plant.h"

#include <cmath>
#include <string>
#include <vector>

#include "cell/runtime/model_plant.h"
#include "ladder/source_files/source_files.h"
#include "plant_models/fmu/fmu_file.h"
#include "plant_models/fmu/fmu_wiring.h"
#include "plant_models/program/program_plant.h"
#include "plant_models/stepped/step_link.h"

namespace stepwright::check {
namespace {

using config::SteppedPlantConfig;

result::Diagnostics check_command(const SteppedPlantConfig& plant) {
  if (plant.command.empty()) return {};  // told already
  if (!stepped::find_program(plant.command.front(), plant.folder).empty()) return {};
  return {{"R0153", result::Severity::Error, plant.where,
           "the plant's program '" + plant.command.front() + "' is not there, or may not be executed",
           "a name is looked for in PATH, a path from the folder of the cell"}};
}

// Steps of another length than the FMU's own, where it has such.
result::Diagnostics check_step(const SteppedPlantConfig& plant, const fmu::ModelDescription& description) {
  if (!description.fixed_step || *description.fixed_step <= 0.0) return {};
  const double steps = std::chrono::duration<double>(plant.step).count() / *description.fixed_step;
  if (std::round(steps) >= 1.0 && std::abs(steps - std::round(steps)) < 1e-6 * steps) return {};
  return {{"C0335", result::Severity::Error, plant.where,
           "step_us = " + std::to_string(plant.step.count()) + " is no multiple of the FMU's own step of " +
               std::to_string(*description.fixed_step) + " s",
           "step_us is [clock] interval_us unless the plant says otherwise"}};
}

result::Diagnostics check_fmu(const SteppedPlantConfig& plant) {
  if (!plant.file.has_filename()) return {};  // told already
  const auto file = fmu::FmuFile::open(plant.file);
  if (!file) return file.error();
  std::vector<fmu::WantedVariable> wanted;
  for (const auto& each : plant.actuators)
    wanted.push_back({each.name, fmu::VariableUse::Actuator, each.where});
  for (const auto& each : plant.sensors) wanted.push_back({each.name, fmu::VariableUse::Sensor, each.where});
  for (const auto& each : plant.values) wanted.push_back({each.name, fmu::VariableUse::Sensor, each.where});
  for (const auto& each : plant.faults) wanted.push_back({each.name, fmu::VariableUse::Fault, each.where});
  for (const auto& each : plant.parameters)
    wanted.push_back({each.name, fmu::VariableUse::Parameter, each.where});
  result::Diagnostics problems = check_step(plant, file->description());
  if (const auto found = fmu::find_variables(file->description(), wanted); !found)
    problems.insert(problems.end(), found.error().begin(), found.error().end());
  return problems;
}

result::Diagnostics check_st(const SteppedPlantConfig& plant) {
  if (plant.sources.empty()) return {};  // told already
  std::vector<std::string> paths;
  for (const std::filesystem::path& each : plant.sources) paths.push_back(each.string());
  result::Diagnostics problems;
  const sources::SourceFiles files = sources::load(paths, problems);
  if (!problems.empty()) return problems;
  auto output = driver::compile(files.input());
  if (!output) return output.error();
  const auto info = reader::ProgramInfo::read(output->container);
  if (!info) return info.error();
  std::vector<program_plant::WantedVariable> wanted;
  for (const auto* list : {&plant.actuators, &plant.sensors}) {
    for (const auto& each : *list) wanted.push_back({each.name, each.where});
  }
  for (const auto* list : {&plant.values, &plant.faults}) {
    for (const auto& each : *list) wanted.push_back({each.name, each.where});
  }
  for (const auto& each : plant.parameters) wanted.push_back({each.name, each.where});
  const auto found = program_plant::find_variables(*info, wanted, {paths.front(), 0, 0});
  return found ? result::Diagnostics{} : found.error();
}

}  // namespace

result::Diagnostics check_plant(const config::CellConfig& config) {
  if (config.plant.kind == "shared") return check_command(config.plant.stepped);
  if (config.plant.kind == "fmu") return check_fmu(config.plant.stepped);
  if (config.plant.kind == "model") return cell_runtime::check_model(config);
  if (config.plant.kind == "st") return check_st(config.plant.stepped);
  return {};
}

}  // namespace stepwright::check
