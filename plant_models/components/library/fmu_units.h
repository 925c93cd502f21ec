#pragma once

// The unit of an FMU's variable. Thread-safe: pure.

#include <optional>

#include "plant_models/components/unit.h"
#include "plant_models/fmu/model_description.h"

namespace stepwright::components::library {

// By its name, unless the FMU defines that name otherwise (FMI 2.0, 2.2.3; FMI 3.0, 2.4.3). Nothing if nobody
// knows it.
std::optional<Unit> unit_of(const fmu::ModelDescription& description, const fmu::ModelVariable& variable);

// Whether a figure means the same in both: "l/s", "0.001 m3 s-1".
bool same_measure(const Unit& a, const Unit& b);

}  // namespace stepwright::components::library
