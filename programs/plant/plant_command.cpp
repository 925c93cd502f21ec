#include "programs/plant/plant_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"
#include "plant_models/components/step_answer.h"
#include "plant_models/core/names.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/temporary_folder.h"
#include "runtime/host/plant_values.h"

namespace stepwright::plant_program {
namespace {

using components::AnswerAction;
using components::ComponentType;
using components::ModelPlant;
using nlohmann::json;
using result::ExitCode;

// Of simulated time.
double seconds_of(const PlantArguments& arguments) {
  return arguments.seconds.value_or(60.0);
}

ExitCode fail(const result::Diagnostics& diagnostics, ExitCode code = ExitCode::BadInput) {
  (void)process::fail(diagnostics, code);
  return code;
}

void print_types() {
  for (const ComponentType& type : components::library::catalogue()) {
    std::printf("%s: %s\n", type.name.c_str(), type.meaning.c_str());
    for (const components::ParameterSpec& spec : type.parameters) {
      const std::string value = spec.fallback.empty() ? "required, " + spec.unit : spec.fallback;
      const std::string choices =
          spec.choices.empty() ? "" : fmt::format(" ({})", fmt::join(spec.choices, ", "));
      std::printf("  %-20s %-16s %s%s\n", spec.name.c_str(), value.c_str(), spec.meaning.c_str(),
                  choices.c_str());
    }
    for (const components::PortSpec& port : type.ports)
      std::printf("  %s %-16s %-16s %s\n", port.role == components::Role::Node ? "->" : "<-",
                  port.name.c_str(), port.unit.c_str(), port.meaning.c_str());
    for (const components::FaultSpec& fault : type.faults)
      std::printf("  !  %-16s %-16s %s\n", fault.name.c_str(), fault.unit.c_str(), fault.meaning.c_str());
  }
}

// "B1=1@5.0"
std::optional<AnswerAction> parse_action(const std::string& text, bool fault) {
  const std::size_t equal = text.find('=');
  if (equal == std::string::npos || equal == 0) return std::nullopt;
  AnswerAction action{text.substr(0, equal), 0.0, 0.0, fault};
  char* end = nullptr;
  action.value = std::strtod(text.c_str() + equal + 1, &end);
  if (end == text.c_str() + equal + 1) return std::nullopt;
  if (*end == '@') {
    const char* const at = end + 1;
    action.at_s = std::strtod(at, &end);
    if (end == at) return std::nullopt;
  }
  return *end == '\0' && std::isfinite(action.value) && action.at_s >= 0.0 ? std::optional(action)
                                                                           : std::nullopt;
}

result::Result<std::vector<AnswerAction>> actions_of(const PlantArguments& arguments) {
  std::vector<AnswerAction> actions;
  result::Diagnostics problems;
  const auto add = [&](const std::vector<std::string>& texts, bool fault) {
    for (const std::string& text : texts) {
      if (const auto action = parse_action(text, fault)) {
        actions.push_back(*action);
      } else {
        problems.push_back({"C0350",
                            result::Severity::Error,
                            {(fault ? "--fault " : "--set ") + text, 0, 0},
                            "this is not NAME=VALUE or NAME=VALUE@SECONDS",
                            fault ? "--fault a1.leak=0.5@20" : "--set B1=1@5"});
      }
    }
  };
  add(arguments.sets, false);
  add(arguments.faults, true);
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return actions;
}

// Times real time in scans of 10 ms, without a controller: what is left to a program and the other processes.
double measure_speed(ModelPlant& plant) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPatience = std::chrono::milliseconds(200);
  constexpr int kScans = 100;
  const auto start = Clock::now();
  double simulated_s = 0.0;
  while (Clock::now() - start < kPatience) {
    for (int i = 0; i < kScans; ++i)
      if (plant.advance(std::chrono::milliseconds(10)) != core::PlantStatus::Good) return 0.0;
    for (std::uint32_t i = 0; i < plant.sensors().size(); ++i) (void)plant.sensor(core::SensorId(i));
    simulated_s += 0.01 * kScans;
  }
  return simulated_s / std::chrono::duration<double>(Clock::now() - start).count();
}

void print_plant(const ModelPlant& plant, double speed) {
  const components::Model& model = plant.model();
  const auto ending = [](std::size_t count) { return count == 1 ? "" : "s"; };
  const std::size_t components = model.text.components.size();
  std::printf("%s: %zu component%s, %zu state%s, %zu loop%s\n", model.text.name.c_str(), components,
              ending(components), model.states, ending(model.states), model.loops.size(),
              ending(model.loops.size()));
  for (const components::Loop& loop : model.loops) std::printf("  solved together: %s\n", loop.names.c_str());
  std::printf("driven by the program\n");
  for (std::size_t i = 0; i < model.actuators.size(); ++i)
    std::printf("  %-20s %-10s %s\n", model.actuators[i].name.c_str(), model.actuator_at[i].address.c_str(),
                model.actuators[i].meaning.c_str());
  std::printf("read by the program\n");
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    std::printf("  %-20s %-10s %s\n", model.sensors[i].name.c_str(), model.sensor_at[i].address.c_str(),
                model.sensors[i].meaning.c_str());
  std::printf("values\n");
  for (std::uint32_t i = 0; i < model.truths.size(); ++i)
    std::printf("  %-28s %12.6g %-10s %s\n", model.truths[i].name.c_str(),
                plant.truth(core::TruthId(i)) + 0.0,  // never -0
                model.truths[i].unit.c_str(), model.truths[i].meaning.c_str());
  std::printf("faults\n");
  for (std::size_t i = 0; i < model.faults.size(); ++i)
    std::printf("  %-28s %g..%g %-10s %s\n", model.faults[i].name.c_str(), model.fault_at[i].low,
                model.fault_at[i].high, model.faults[i].unit.c_str(), model.faults[i].meaning.c_str());
  std::printf("about %.0f times real time\n", speed);
}

json plant_json(const ModelPlant& plant, double speed) {
  const components::Model& model = plant.model();
  json document = {{"name", model.text.name},    {"components", model.text.components.size()},
                   {"states", model.states},     {"loops", json::array()},
                   {"actuators", json::array()}, {"sensors", json::array()},
                   {"values", json::array()},    {"faults", json::array()},
                   {"realtime_factor", speed}};
  for (const components::Loop& loop : model.loops) document["loops"].push_back(loop.names);
  for (std::size_t i = 0; i < model.actuators.size(); ++i)
    document["actuators"].push_back(
        {{"name", model.actuators[i].name}, {"address", model.actuator_at[i].address}});
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    document["sensors"].push_back({{"name", model.sensors[i].name}, {"address", model.sensor_at[i].address}});
  for (const core::Quantity& truth : model.truths)
    document["values"].push_back({{"name", truth.name}, {"unit", truth.unit}});
  for (const core::Quantity& fault : model.faults)
    document["faults"].push_back({{"name", fault.name}, {"unit", fault.unit}});
  return document;
}

ExitCode write(const std::string& file, const std::string& text) {
  if (file.empty()) return ExitCode::Done;
  const result::Diagnostics unwritten = files::write_file(file, text);
  return unwritten.empty() ? ExitCode::Done : fail(unwritten);
}

// `processes`: the folder for its parts that are processes.
result::Result<std::unique_ptr<ModelPlant>> load(const PlantArguments& arguments,
                                                 const std::filesystem::path& processes = {}) {
  return ModelPlant::load(arguments.file, components::library::catalogue(),
                          {.seed = arguments.seed, .processes = processes});
}

// The plant with its processes.
result::Result<std::unique_ptr<ModelPlant>> start(const PlantArguments& arguments,
                                                  const process::TemporaryFolder& folder) {
  if (folder.path().empty())
    return result::fail("M0004", {}, "no temporary folder can be made for the plant's processes",
                        "TMPDIR names a folder that can be written");
  auto plant = load(arguments, folder.path());
  if (!plant) return plant;
  if (auto started = (*plant)->start(); !started) return result::forward(started);
  return plant;
}

result::Diagnostics why_it_failed(ModelPlant& plant, const PlantArguments& arguments) {
  return {{plant.lost_process() ? "C0337" : "C0351",
           result::Severity::Error,
           {arguments.file, 0, 0},
           plant.trouble(),
           {}}};
}

// A runtime has bounds that a plant alone has not.
void warn_of_bounds(const ModelPlant& plant, const PlantArguments& arguments) {
  result::Diagnostics problems =
      host::check_plant_values(core::names_of(plant.truths()), {arguments.file, 0, 0});
  for (result::Diagnostic& problem : problems) problem.severity = result::Severity::Warning;
  if (!problems.empty()) (void)process::fail(problems, ExitCode::Done);
}

void print_end(const components::StepAnswer& answer) {
  std::printf("after %g s\n", answer.times_s.back());
  for (const components::AnswerColumn& column : answer.columns)
    std::printf("  %-28s %12.6g %s\n", column.name.c_str(), column.values.back() + 0.0,  // never -0
                column.unit.c_str());
}

// Runs the plant and writes what it answers.
ExitCode answer(const PlantArguments& arguments) {
  auto actions = actions_of(arguments);
  if (!actions) return fail(actions.error());
  const process::TemporaryFolder folder(process::temporary_place());
  auto plant = start(arguments, folder);
  if (!plant) return fail(plant.error());
  const std::chrono::nanoseconds interval(
      std::max<std::int64_t>(1, std::llround(arguments.interval_s * 1e9)));
  auto answered =
      components::record_answer(**plant, {seconds_of(arguments), interval, arguments.values, *actions});
  if (!answered) return fail(answered.error());
  if (const ExitCode code = write(arguments.csv_file, components::to_csv(*answered)); code != ExitCode::Done)
    return code;
  const ExitCode drawn =
      write(arguments.svg_file, components::to_svg(*answered, (*plant)->model().text.name));
  if (drawn != ExitCode::Done) return drawn;
  if (arguments.csv_file.empty() && arguments.svg_file.empty()) print_end(*answered);
  return answered->failed ? fail(why_it_failed(**plant, arguments), ExitCode::RuntimeFault) : ExitCode::Done;
}

}  // namespace

ExitCode run_plant(const PlantArguments& arguments) {
  if (arguments.types) {
    print_types();
    return ExitCode::Done;
  }
  for (const std::string& name : {arguments.csv_file, arguments.svg_file, arguments.json_file}) {
    if (name.empty()) continue;
    if (const auto unwritable = files::check_writable(name); !unwritable.empty()) return fail(unwritable);
  }
  auto plant = load(arguments);
  if (!plant) return fail(plant.error());
  const bool to_stdout = arguments.csv_file == "-" || arguments.svg_file == "-" || arguments.json_file == "-";
  const bool runs = !arguments.csv_file.empty() || !arguments.svg_file.empty() || !arguments.sets.empty() ||
                    !arguments.faults.empty() || !arguments.values.empty() || arguments.seconds;
  warn_of_bounds(**plant, arguments);
  const bool lists = !runs || !arguments.json_file.empty();
  if (lists) {
    const process::TemporaryFolder folder(process::temporary_place());
    auto trial = start(arguments, folder);
    if (!trial) return fail(trial.error());
    const double speed = measure_speed(**trial);
    if ((*trial)->failed()) return fail(why_it_failed(**trial, arguments), ExitCode::RuntimeFault);
    if (!to_stdout) print_plant(**plant, speed);
    const ExitCode written =
        write(arguments.json_file,
              plant_json(**plant, speed).dump(1, ' ', false, json::error_handler_t::replace) + "\n");
    if (written != ExitCode::Done) return written;
  }
  return runs ? answer(arguments) : ExitCode::Done;
}

}  // namespace stepwright::plant_program
