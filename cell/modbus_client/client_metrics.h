#pragma once

// Metrics of a Modbus client for Prometheus: of each device its state, requests, errors and times, of each
// group its periods, of the tags their quality. Pure; any thread. runtime/doc/modbus_client.md lists them.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace stepwright::modbus_client {

// Of what to_json (status_json.h) gives, here or in the process that runs. Text exposition format 0.0.4;
// every sample has the labels `cell` and `device`.
std::string to_metrics(const nlohmann::json& status);

}  // namespace stepwright::modbus_client
