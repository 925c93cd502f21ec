#include "plant_models/fmu/fmu_call.h"

#include "plant_models/stepped/installed_peer.h"

namespace stepwright::fmu {

std::vector<std::string> fmu_call(const FmuOptions& options, const std::filesystem::path& programs) {
  std::vector<std::string> call = stepped::installed_peer("fmu", options.parameters, programs);
  call.insert(call.end(), {"--folder", std::filesystem::absolute(options.folder).string(), "--",
                           std::filesystem::absolute(options.file).string()});
  return call;
}

}  // namespace stepwright::fmu
