#pragma once

// Faults that many components have. Pure.
//
//   .faults = {flag_fault("stuck", "1: it stays where it is"), ...}

#include <string>
#include <utility>

#include "plant_models/components/component_type.h"

namespace stepwright::components::library {

// 1: it is there; 0: all is well.
inline FaultSpec flag_fault(std::string name, std::string meaning) {
  return {.name = std::move(name),
          .low = 0.0,
          .high = 1.0,
          .rest = 0.0,
          .meaning = std::move(meaning),
          .whole = true};
}

// A contact that shows 0 or 1 whatever is true: neither is like the contact without it.
inline FaultSpec contact_fault(std::string name, std::string meaning) {
  return {.name = std::move(name), .low = 0.0, .high = 1.0, .meaning = std::move(meaning), .whole = true};
}

}  // namespace stepwright::components::library
