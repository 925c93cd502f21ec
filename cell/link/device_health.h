#pragma once

// Reads what `stepwright modbus-client` says about its devices (cell/modbus_client/status_json.h). It
// comes from another process: what is missing or of another type refuses the whole text.
//
//   const auto devices = device_health(*ask_status(path));      // nullopt: not what a client says
//
// Pure; any thread.

#include <optional>
#include <string>
#include <vector>

#include "runtime/dds/health.h"

namespace stepwright::link {

std::optional<std::vector<dds::DeviceHealth>> device_health(const std::string& text);

}  // namespace stepwright::link
