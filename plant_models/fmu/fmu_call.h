#pragma once

// Call of the process of an FMU. Thread-safe: pure.

#include <filesystem>
#include <string>
#include <vector>

#include "plant_models/fmu/fmu_plant.h"

namespace stepwright::fmu {

// `programs`: as stepped::installed_peer().
std::vector<std::string> fmu_call(const FmuOptions& options, const std::filesystem::path& programs = {});

}  // namespace stepwright::fmu
