#pragma once

// Which variable of an FMU stands behind each terminal, value, fault and parameter of a cell, by its name.
//
// Thread-safe: pure. C0335: the FMU has no such variable, or one that cannot be what the cell wants of it.

#include <string>
#include <vector>

#include "plant_models/fmu/model_description.h"
#include "runtime/ground/result/result.h"

namespace stepwright::fmu {

enum class VariableUse : std::uint8_t {
  Actuator,   // an input
  Sensor,     // any variable that can be read
  Fault,      // an input, or a parameter that can be changed while it runs
  Parameter,  // anything that has a start value
};

struct WantedVariable {
  std::string name;
  VariableUse use = VariableUse::Sensor;
  result::Location where = {};
};

// By the order of `wanted`.
[[nodiscard]] result::Result<std::vector<const ModelVariable*>> find_variables(
    const ModelDescription& description, const std::vector<WantedVariable>& wanted);

}  // namespace stepwright::fmu
