#include "plant_models/assemblies/port_target.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "plant_models/core/names.h"

namespace stepwright::assemblies {

// Six decimals say nothing of what is very small, and hundreds of digits nothing of what is very large.
std::string number_text(double value) {
  const double size = std::abs(value);
  if (value != 0.0 && !(size >= 1e-3 && size < 1e15)) {
    std::array<char, 32> power{};
    std::snprintf(power.data(), power.size(), "%g", value);
    return power.data();
  }
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

result::Result<std::size_t> find_fault(std::string_view plant, std::span<const core::Quantity> faults,
                                       std::string_view name) {
  const auto fault = core::index_of(faults, name);
  if (!fault) {
    return result::fail("C0311", {}, std::string(plant) + " has no fault named '" + std::string(name) + "'",
                        core::known_names(faults, name, "known faults: "));
  }
  return *fault;
}

result::Result<void> check_fault(const core::Quantity& fault, const FaultRange& range, double value) {
  const bool whole = !range.whole || value == std::floor(value);
  if (value >= range.min && value <= range.max && whole) return {};
  return result::fail("C0312", {}, "fault '" + fault.name + "' cannot have the value " + number_text(value),
                      "allowed: " + number_text(range.min) + " to " + number_text(range.max) +
                          (range.whole ? ", whole numbers; " : "; ") + fault.meaning);
}

}  // namespace stepwright::assemblies
