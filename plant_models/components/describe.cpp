#include "plant_models/components/describe.h"

namespace stepwright::components {

core::PlantDescription describe(const Model& model) {
  core::PlantDescription description;
  description.name = model.text.name;
  return description;
}

}  // namespace stepwright::components
