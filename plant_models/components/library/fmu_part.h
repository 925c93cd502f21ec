#pragma once

// An FMU as a component: its inputs and outputs are ports, its process is stepped at the exchanges of the
// plant. Before it has been started its outputs are what its description says of the start.
//
// Thread rule: ProcessPart.

#include <memory>
#include <string>
#include <vector>

#include "plant_models/components/process_part.h"
#include "plant_models/components/unit.h"
#include "plant_models/stepped/step_link.h"

namespace stepwright::components::library {

// A variable of the FMU, whose number there is in its own unit.
struct FmuPort {
  std::string name;
  Unit unit;
  double start = 0.0;  // SI
  bool is_switch = false;
};

struct FmuSetup {
  std::string name;              // of the component
  std::vector<FmuPort> inputs;   // the first ports of the type,
  std::vector<FmuPort> outputs;  // and the ones behind them
  std::vector<FmuPort> faults;   // in the order of the type's
  stepped::StepCommand command;
  std::uint64_t seed = 1;
};

std::unique_ptr<Component> make_fmu_part(std::shared_ptr<const FmuSetup> setup);

}  // namespace stepwright::components::library
