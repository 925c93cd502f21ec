#pragma once

// What a viewer needs to draw a described plant. Pure.

#include "plant_models/components/model.h"
#include "plant_models/core/plant_description.h"

namespace stepwright::components {

core::PlantDescription describe(const Model& model);

}  // namespace stepwright::components
