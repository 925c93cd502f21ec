#pragma once

// The tank bench with its real planner, compiler, scan and plant, in one thread.

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "supervisor/executive/executive.h"
#include "tests/support/controller/simulated_controller.h"

namespace stepwright::executive {

inline PlanningOptions bench_planning_options() {
  const std::string cell = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/";
  PlanningOptions options;
  options.domain = cell + "domain.pddl";
  options.problem = cell + "problem.pddl";
  options.binding = cell + "binding.toml";
  return options;
}

inline const PlanningService& bench_planning() {
  static const PlanningService planning = [] {
    auto opened = PlanningService::open(bench_planning_options());
    if (!opened) throw std::runtime_error(result::to_string(opened.error()));
    return std::move(*opened);
  }();
  return planning;
}

// The bench with other lines of its binding in place of those that match `lines`.
inline PlanningService bench_planning_with(const std::string& lines, const std::string& others,
                                           const std::filesystem::path& folder) {
  PlanningOptions options = bench_planning_options();
  std::stringstream text;
  text << std::ifstream(options.binding).rdbuf();
  options.binding = folder / "binding.toml";
  std::ofstream(options.binding) << std::regex_replace(text.str(), std::regex(lines), others);
  auto opened = PlanningService::open(options);
  if (!opened) throw std::runtime_error(result::to_string(opened.error()));
  return std::move(*opened);
}

// And with lines left out: of transmitters without noise and without bias.
inline PlanningService bench_planning_without(const std::string& lines, const std::filesystem::path& folder) {
  return bench_planning_with(lines, "", folder);
}

inline assemblies::BenchParameters exact_bench() {
  assemblies::BenchParameters parameters;
  parameters.uncertainty = assemblies::SensorUncertainty::none();
  return parameters;
}

inline run::RunRecord run_bench(support::SimulatedController& controller, ExecutiveOptions options = {},
                                const PlanningService& planning = bench_planning()) {
  options.cell = "bench";
  return Executive(planning, controller, std::move(options), {}).run();
}

// For messages of failed tests.
inline std::string story(const run::RunRecord& record) {
  std::string text = std::string(to_string(record.phase)) + ": " + record.message;
  for (const run::Replan& replan : record.replans) {
    text += "\n  " + std::to_string(replan.time_s) + " s after " + replan.after_action + ": " + replan.cause;
  }
  return text;
}

}  // namespace stepwright::executive
