#pragma once

// Status of a client's devices: as JSON (keys with units), which is what comes over the socket, and as lines
// for people, which are made of it. Pure; any thread. For Prometheus: client_metrics.h.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "runtime/modbus/client/poll/status.h"

namespace stepwright::modbus_client {

// {"cell", "devices": [{"name", "endpoint", "unit", "online", "lost", "error", counters, "groups": [...],
// "tags": [{"name", "address", "value", "quality", "quality_text", "age_ms", "time"}]}]}
nlohmann::json to_json(const std::string& cell, std::span<const modbus::client::DeviceStatus> devices);

std::string to_lines(const nlohmann::json& status);

}  // namespace stepwright::modbus_client
