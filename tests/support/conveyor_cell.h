#pragma once

// The sorting line with its real planner, compiler, safety program, scan and plant, in one thread.

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/missions/planning/executive_options.h"
#include "plant_models/assemblies/sorting_line.h"
#include "supervisor/executive/executive.h"
#include "tests/support/controller/simulated_controller.h"

namespace stepwright::executive {

inline const config::CellConfig& conveyor_cell() {
  static const config::CellConfig cell = [] {
    auto loaded = config::load_cell_config(STEPWRIGHT_SOURCE_DIR "/tests/cells/conveyor/cell.toml");
    if (!loaded) throw std::runtime_error(result::to_string(loaded.error()));
    return std::move(*loaded);
  }();
  return cell;
}

inline const PlanningService& conveyor_planning() {
  static const PlanningService planning = [] {
    auto opened = PlanningService::open(missions::planning_options(conveyor_cell()));
    if (!opened) throw std::runtime_error(result::to_string(opened.error()));
    return std::move(*opened);
  }();
  return planning;
}

inline support::SimulatedController conveyor_controller(std::uint64_t seed,
                                                        std::vector<support::PlantFault> faults = {}) {
  auto line = assemblies::SortingLine::create({.seed = seed});
  if (!line) throw std::runtime_error(result::to_string(line.error()));
  std::vector<bridge::PortWire> wires;
  for (const config::PortAddress& port : conveyor_cell().plant.ports)
    wires.push_back({port.port, port.address, port.where});
  return support::SimulatedController(std::move(*line), wires, {10, 2}, std::move(faults));
}

inline run::RunRecord run_conveyor(support::SimulatedController& controller, int max_replans = 8) {
  ExecutiveOptions options;
  options.cell = "conveyor";
  options.max_replans = max_replans;
  options.settle = conveyor_cell().executive.settle;
  return Executive(conveyor_planning(), controller, std::move(options), {}).run();
}

// Where the plant itself says that its boxes are: box -> (chute, place in it).
inline std::map<int, std::pair<int, int>> sorted_boxes(const support::SimulatedController& controller) {
  std::map<int, std::pair<int, int>> boxes;
  for (int box = 1; box <= 5; ++box) {
    const std::string name = "box_" + std::to_string(box);
    boxes[box] = {static_cast<int>(controller.plant_value(name + "_chute")),
                  static_cast<int>(controller.plant_value(name + "_rank"))};
  }
  return boxes;
}

// The goal of problem.pddl: b3 before b1 in chute 1, b4 before b2 in chute 2, b5 in chute 3.
inline std::map<int, std::pair<int, int>> ordered_boxes() {
  return {{1, {1, 2}}, {2, {2, 2}}, {3, {1, 1}}, {4, {2, 1}}, {5, {3, 1}}};
}

}  // namespace stepwright::executive
