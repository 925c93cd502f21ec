#pragma once

// The controller of cell/simulation as tests have it, also around a tank bench by its parameters.
//
//   SimulatedController controller({.seed = 7});
//   Executive(service, controller, {}, {}).run();
//   controller.plant_value("level_a1_percent");

#include <utility>
#include <vector>

#include "cell/simulation/simulated_controller.h"
#include "plant_models/assemblies/tank_bench.h"

namespace stepwright::support {

using simulation::PlantFault;

class SimulatedController final : public simulation::SimulatedController {
 public:
  using simulation::SimulatedController::SimulatedController;
  explicit SimulatedController(const assemblies::BenchParameters& parameters,
                               std::vector<PlantFault> faults = {})
      : simulation::SimulatedController(assemblies::TankBench::create(parameters).value(),
                                        bridge::default_bench_wires(), {8, 1}, std::move(faults)) {}
};

}  // namespace stepwright::support
