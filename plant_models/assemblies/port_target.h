#pragma once

// Targets of a plant's numbered ports, truths and faults, and the values that a fault may have. Pure; any
// thread.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "plant_models/core/port.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

template <typename Kind>
struct PortTarget {
  Kind kind{};
  std::size_t index = 0;  // of the thing of that kind
};

using core::FaultRange;

// "0.5", "40": as short as it is.
std::string number_text(double value);

// The index of the fault with that name. `plant` is for the message: "the sorting line". Fails with C0311 (no
// such fault).
[[nodiscard]] result::Result<std::size_t> find_fault(std::string_view plant,
                                                     std::span<const core::Quantity> faults,
                                                     std::string_view name);

// Fails with C0312 if the fault cannot have that value.
[[nodiscard]] result::Result<void> check_fault(const core::Quantity& fault, const FaultRange& range,
                                               double value);

}  // namespace stepwright::assemblies
