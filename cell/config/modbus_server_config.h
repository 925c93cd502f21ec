#pragma once

// [modbus.server] of a cell's configuration: the cell's runtime as a Modbus slave (`stepwright
// modbus-server`, runtime/doc/modbus.md). Off unless it is enabled, on loopback unless it is bound elsewhere,
// and nobody writes anything unless both the addresses and the client's windows allow it:
//
//   [modbus.server]
//   enabled = true
//   bind = "0.0.0.0"
//   port = 502
//   allow = ["192.168.1.0/24"]
//   [[modbus.server.range]]
//   table = "holding"              # "coils", "discrete", "holding", "input"
//   first = 0
//   variable = "MAIN.levels"       # or address = "%MW0"
//   count = 10                     # values; default: the one, or the whole array
//   writable = true
//   [[modbus.server.client]]
//   address = "192.168.1.7"        # or a network; role = "..." of a certificate
//   read = ["all"]
//   write = ["holding 0-19", "coils 3"]
//
// Diagnostics with their place: C0506 no address or network, C0507 no window, C0508 a range or a client that
// says too little or too much. What needs the program (C0501 to C0505) is found when the map is built.

#include "cell/config/metrics_config.h"
#include "cell/config/modbus_acceptors_config.h"
#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"
#include "runtime/modbus/map/map_config.h"
#include "runtime/modbus/server/options.h"
#include "runtime/modbus/server/tcp_acceptor.h"

namespace stepwright::config {

struct ModbusServerConfig {
  bool enabled = false;
  modbus::server::TcpOptions tcp;
  ModbusAcceptors acceptors;  // beside `tcp`
  modbus::server::ServerOptions server;
  modbus::map::MapConfig map;
  MetricsConfig metrics;                           // [modbus.server.metrics]
  std::chrono::milliseconds stale_after{1'000};    // without news of the runtime: exception 4
  std::chrono::milliseconds write_timeout{2'000};  // until a write is in the image; then exception 4
};

// Reads the table [modbus.server]; what the document itself reports goes there.
[[nodiscard]] result::Diagnostics read_modbus_server(const settings::TomlTable& table,
                                                     ModbusServerConfig& config);

}  // namespace stepwright::config
