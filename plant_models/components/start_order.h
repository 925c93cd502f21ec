#pragma once

// Order of the starts of states that need each other, found along the order in which values are worked out.
// Pure; at set-up.

#include <cstdint>
#include <vector>

#include "plant_models/components/model.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

struct StartOfState {
  std::uint32_t component = 0;
  FollowingStart follows;
};

// All starts of the plant that are no figures.
std::vector<StartOfState> following_starts_of(const Model& model);

// How many of the starts follow each other at most, one by one. Fails with C0346 at the place of a start that
// is in a circle of them.
[[nodiscard]] result::Result<std::size_t> depth_of(const std::vector<StartOfState>& starts,
                                                   const Model& model);

}  // namespace stepwright::components
