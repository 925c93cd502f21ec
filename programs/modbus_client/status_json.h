#pragma once

// What a client says about its devices: as JSON (keys with units), as lines for people, as figures for
// Prometheus. The last two are made of the first, which is what comes over the socket. Pure; any thread.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "runtime/modbus/client/poll/status.h"

namespace stepwright::modbus_client {

// {"cell", "devices": [{"name", "endpoint", "unit", "online", "lost", "error", counters, "groups": [...],
// "tags": [{"name", "address", "value", "quality", "quality_text", "age_ms", "time"}]}]}
nlohmann::json to_json(const std::string& cell, std::span<const modbus::client::DeviceStatus> devices);

std::string to_lines(const nlohmann::json& status);

// Text exposition format 0.0.4.
std::string to_metrics(const nlohmann::json& status);

}  // namespace stepwright::modbus_client
