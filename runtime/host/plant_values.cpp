#include "runtime/host/plant_values.h"

#include "runtime/host/limits.h"

namespace stepwright::host {

result::Diagnostics check_plant_values(std::span<const std::string> names, const result::Location& where) {
  result::Diagnostics problems;
  if (names.size() > kMaxPlantValues) {
    problems.push_back({"R0081", result::Severity::Error, where,
                        "the plant has " + std::to_string(names.size()) + " values; a runtime publishes " +
                            std::to_string(kMaxPlantValues) + " at most",
                        "fewer components, or several cells"});
  }
  for (const std::string& name : names) {
    if (name.size() <= kMaxNameBytes) continue;
    problems.push_back({"R0081", result::Severity::Error, where,
                        "the plant's value '" + name + "' has a name of " + std::to_string(name.size()) +
                            " bytes; " + std::to_string(kMaxNameBytes) + " are possible",
                        "a shorter name of its component"});
  }
  return problems;
}

}  // namespace stepwright::host
