#pragma once

// States that each derivative of a plant depends on, found along the order in which values are worked out:
// for sparse Jacobians. Pure; at set-up.

#include <cstdint>
#include <vector>

#include "plant_models/components/model.h"

namespace stepwright::components {

// For each state the states that its derivative reads, in ascending order.
std::vector<std::vector<std::uint32_t>> dependencies_of(const Model& model);

}  // namespace stepwright::components
