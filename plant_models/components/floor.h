#pragma once

// The floor of a plant: takes what overflows or leaks, for good, and says how much it was. Every plant with
// liquid has one, named "floor".

#include "plant_models/components/component_type.h"

namespace stepwright::components {

const ComponentType& floor_type();

}  // namespace stepwright::components
