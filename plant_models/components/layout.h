#pragma once

// Layout of the components of a plant in a drawing: a column for each step that liquid, heat and signals take
// from where they come from (Sugiyama, Tagawa, Toda, "Methods for visual understanding of hierarchical system
// structures", 1981: layers, then order within a layer by the mean of the neighbours). Pure.

#include <cstdint>
#include <vector>

#include "plant_models/components/model.h"

namespace stepwright::components {

struct Placed {
  std::uint32_t component = 0;
  std::uint32_t column = 0;
  std::uint32_t row = 0;
};

struct Layout {
  std::vector<Placed> placed;  // by component
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
};

Layout lay_out(const Model& model);

}  // namespace stepwright::components
