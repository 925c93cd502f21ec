#pragma once

// Address at which a process serves its own figures to Prometheus: [modbus.server.metrics],
// [modbus.client.metrics], [controller.metrics]. The keys are those of [hmi], which serves the runtime's.
//
//   [modbus.server.metrics]
//   host = "127.0.0.1"     # a name or address of this machine, the one by which it is scraped
//   port = 9502            # nothing listens without it; 0: any free one
//
// Pure.

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct MetricsConfig {
  std::string host = "127.0.0.1";
  std::optional<std::uint16_t> port;  // none: no figures over HTTP
  result::Location where;             // of the port
};

// Reads the table `metrics` of `owner`; what is wrong is reported with the document (C0002 to C0005).
MetricsConfig read_metrics(const settings::TomlTable& owner);

}  // namespace stepwright::config
