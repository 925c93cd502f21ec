#pragma once

// The order in which the equations of a plant are worked out. Thread-safe: pure.

#include <vector>

#include "plant_models/components/model.h"

namespace stepwright::components {

// One thing that is worked out, with what it needs and sets (places in the vector of values).
struct OrderNode {
  Step step{};
  std::vector<std::uint32_t> reads{};
  std::vector<std::uint32_t> writes{};
  bool unknown = false;           // of a junction: `writes` are sought, `reads` have to be zero
  std::vector<double> typical{};  // of the unknowns
  std::vector<double> typical_residual{};
  std::uint32_t component = 0;  // for messages; of a junction: the first one that it joins
};

// Fills `order`, `shown`, `watched` and `loops` of the model, whose terminals and components have their
// places. Fails with a C0346 for each circle without a state, at the place of one of its components.
[[nodiscard]] result::Result<void> put_in_order(const std::vector<OrderNode>& nodes, Model& model);

}  // namespace stepwright::components
