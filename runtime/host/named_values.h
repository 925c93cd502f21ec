#pragma once

// Values of a simulated plant with their names, as messages carry them. Pure.

#include <span>
#include <string>
#include <vector>

#include "runtime/host/messages.h"

namespace stepwright::host {

// Requires as many names as values.
inline std::vector<NamedValue> named_values(std::span<const std::string> names,
                                            std::span<const double> values) {
  std::vector<NamedValue> named;
  for (std::size_t i = 0; i < values.size(); ++i) named.push_back({names[i], values[i]});
  return named;
}

}  // namespace stepwright::host
