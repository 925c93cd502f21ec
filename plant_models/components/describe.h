#pragma once

// Description of a plant of components, for viewers that draw it. Pure.

#include "plant_models/components/model.h"
#include "plant_models/core/plant_description.h"

namespace stepwright::components {

core::PlantDescription describe(const Model& model);

}  // namespace stepwright::components
