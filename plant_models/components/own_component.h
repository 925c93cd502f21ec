#pragma once

// A component that works by the equations of a plant's file.

#include <memory>

#include "plant_models/components/component_type.h"
#include "plant_models/components/expression.h"
#include "plant_models/components/own_equations.h"

namespace stepwright::components {

// The variables that an equation can name: parameters, faults, what is read, states, and t (s). Their places
// are in `values`, which is resized to hold them.
std::vector<Variable> variables_of(const OwnEquations& equations, std::vector<double>& values);

// Requires equations that read_own_type() has found right.
std::unique_ptr<Component> make_own(std::shared_ptr<const OwnEquations> equations,
                                    const Parameters& parameters);

}  // namespace stepwright::components
