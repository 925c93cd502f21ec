#include "supervisor/fleet/program/fleet_program.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "supervisor/fleet/program/interlocks.h"
#include "supervisor/fleet/program/mission_chart.h"
#include "supervisor/fleet/program/program_texts.h"
#include "supervisor/fleet/program/tables.h"
#include "supervisor/vehicle/news_chart.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::fleet {
namespace {

using graphic::Variable;

constexpr const char* kTask = "fleet";

class ProjectWriter {
 public:
  ProjectWriter(const FleetPlan& plan, const FleetTerminals& terminals, const ProgramOptions& options)
      : plan_(plan), terminals_(terminals), options_(options) {
    graphic::NameSet taken;
    for (const VehicleMission& mission : plan.missions) {
      names_.push_back(taken.unique(graphic::make_identifier(mission.vehicle)));
    }
  }

  result::Result<FleetProgram> write() {
    auto interlocks = find_interlocks(plan_, options_);
    if (!interlocks) return result::forward(interlocks);
    auto& project = made_.project;
    project.name = "fleet";
    project.globals = shared_globals(terminals_);
    std::vector<VehicleNames> vehicles;
    for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
      auto tables = vehicle_tables(plan_.missions[v], names_[v], interlocks->places[v].free_m, options_);
      if (!tables) return result::forward(tables);
      vehicles.push_back(add_tables(v, std::move(*tables)));
    }
    for (Variable& each : time_globals(plan_, interlocks->times)) project.globals.push_back(std::move(each));
    // Charts see the places of their own scan, drives what charts permit.
    vehicle::add_text(project, kTask, "sensing",
                      sensing_text(plan_, vehicles, interlocks->times, options_.revision),
                      sensing_blocks(vehicles, interlocks->times, options_.revision));
    for (std::uint32_t v = 0; v < plan_.missions.size(); ++v) add_chart(v, *interlocks);
    vehicle::add_text(project, kTask, "driving", driving_text(vehicles, options_),
                      driving_blocks(vehicles, options_));
    if (options_.news_every.count() > 0) {
      vehicle::add_chart(project, kTask, kNewsProgram, vehicle::news_chart(options_.news_every));
    }
    project.tasks = {{kTask, options_.interval_us, 0}};
    for (const TimeLimit& limit : interlocks->times.limits) {
      made_.limits.push_back({limit.constraint, interlocks->times.events[limit.event].vehicle, limit.within});
    }
    add_warnings(interlocks->times.open);
    return std::move(made_);
  }

 private:
  VehicleNames add_tables(std::size_t v, VehicleTables tables) {
    VehicleNames names{names_[v], tables.path.name, tables.areas.name, tables.planes.name, v};
    auto& globals = made_.project.globals;
    for (Variable& each : vehicle_globals(plan_.missions[v], names, terminals_.vehicles[v], options_)) {
      globals.push_back(std::move(each));
    }
    if (!tables.path.name.empty()) globals.push_back(std::move(tables.path));
    globals.push_back(std::move(tables.areas));
    globals.push_back(std::move(tables.planes));
    made_.figures.samples += tables.samples;
    made_.figures.polygons += tables.polygons;
    made_.figures.planes += tables.sides;
    made_.figures.table_bytes += tables.bytes;
    return names;
  }

  void add_chart(std::uint32_t v, const Interlocks& interlocks) {
    MissionChart chart = mission_chart(plan_, names_, interlocks, v, options_);
    for (const auto& waits : interlocks.before[v]) made_.figures.interlocks += waits.size();
    made_.missions.push_back(
        {plan_.missions[v].vehicle, names_[v], "mission_" + names_[v], std::move(chart.steps)});
    vehicle::add_chart(made_.project, kTask, made_.missions.back().program, std::move(chart.chart));
  }

  void add_warnings(const std::vector<std::uint32_t>& open) {
    for (const std::uint32_t constraint : open) {
      result::Diagnostic warning;
      warning.code = "F1106";
      warning.severity = result::Severity::Warning;
      warning.message = fmt::format("the program does not see to all of the constraint '{}'",
                                    plan_.constraints[constraint].name);
      warning.hint = "who waits for it would wait for ever: what it waits for comes only behind it";
      made_.warnings.push_back(std::move(warning));
    }
  }

  const FleetPlan& plan_;
  const FleetTerminals& terminals_;
  const ProgramOptions& options_;
  std::vector<std::string> names_;
  FleetProgram made_;
};

result::Result<void> check_options(const ProgramOptions& options) {
  const DriveData& d = options.drive;
  const FleetMargins& m = options.margins;
  const std::pair<const char*, double> figures[] = {
      {"speed_up_m_s2", d.speed_up_m_s2},     {"brake_m_s2", d.brake_m_s2},
      {"hard_brake_m_s2", d.hard_brake_m_s2}, {"lateral_m_s2", d.lateral_m_s2},
      {"lock_rate_rad_s", d.lock_rate_rad_s}, {"speed_lag_s", d.speed_lag_s},
      {"lock_lag_s", d.lock_lag_s},           {"halt_before_m", m.halt_before_m},
      {"left_behind_m", m.left_behind_m},     {"outside_m", m.outside_m},
      {"sample_m", options.sample_m},         {"interval_us", static_cast<double>(options.interval_us)}};
  for (const auto& [name, value] : figures) {
    if (!(std::isfinite(value) && value > 0.0)) {
      return result::fail("F1105", {}, fmt::format("{} is {}, not above zero", name, value));
    }
  }
  return {};
}

result::Result<void> check_terminals(const FleetPlan& plan, const FleetTerminals& terminals) {
  if (terminals.vehicles.size() != plan.missions.size()) {
    return result::fail("F1105", {},
                        fmt::format("terminals of {} vehicles for a plan of {}", terminals.vehicles.size(),
                                    plan.missions.size()));
  }
  if (terminals.estop_ok.empty()) {
    return result::fail("F1105", {}, "the emergency stop has no terminal", "give the address of estop_ok");
  }
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    for (const auto& [name, address] : named_terminals(terminals.vehicles[v])) {
      if (!address.empty()) continue;
      return result::fail("F1105", {},
                          fmt::format("vehicle '{}' has no terminal for {}", plan.missions[v].vehicle, name),
                          "each terminal of a vehicle needs an address");
    }
  }
  return {};
}

}  // namespace

result::Result<FleetProgram> fleet_program(const FleetPlan& plan, const FleetTerminals& terminals,
                                           const ProgramOptions& options) {
  if (auto good = check_options(options); !good) return result::forward(good);
  if (auto good = check_terminals(plan, terminals); !good) return result::forward(good);
  return ProjectWriter(plan, terminals, options).write();
}

}  // namespace stepwright::fleet
