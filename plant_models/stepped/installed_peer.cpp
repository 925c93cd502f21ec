#include "plant_models/stepped/installed_peer.h"

#include <array>
#include <cstdio>

namespace stepwright::stepped {

std::vector<std::string> installed_peer(const std::string& kind,
                                        const std::vector<std::pair<std::string, double>>& parameters,
                                        std::filesystem::path programs) {
  if (programs.empty()) programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string name = "plant-" + kind;
  std::vector<std::string> call = {(programs / ("stepwright-" + name)).string(), name};
  for (const auto& [parameter, value] : parameters) {
    std::array<char, 40> number{};
    std::snprintf(number.data(), number.size(), "%.17g", value);
    call.insert(call.end(), {"--parameter", parameter, number.data()});
  }
  return call;
}

}  // namespace stepwright::stepped
