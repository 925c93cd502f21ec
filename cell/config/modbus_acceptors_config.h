#pragma once

// The other ways into the Modbus server of a cell: TLS and serial lines (runtime/doc/modbus_security.md,
// modbus_line.md).
//
//   [modbus.server]
//   plain = false                    # no Modbus TCP without TLS; default: true
//   [modbus.server.tls]
//   bind = "0.0.0.0"
//   port = 802
//   certificate = "tls/plc.crt"
//   key = "tls/plc.key"
//   authorities = "tls/plant-ca.crt"
//   [[modbus.server.line]]
//   device = "/dev/ttyUSB0"
//   unit = 1
//
// Diagnostics with their place: C0511 no address to bind, C0512 a file that does not exist, C0513 a speed
// that no line has, C0514 a device twice, C0515 a client's role where nobody shows one, C0516 no acceptor at
// all.

#include <filesystem>
#include <optional>
#include <vector>

#include "runtime/ground/settings/toml_document.h"
#include "runtime/modbus/server/line/serial_line.h"
#include "runtime/modbus/server/options.h"
#include "runtime/modbus/server/tcp_acceptor.h"
#include "runtime/modbus/server/tls/tls_context.h"

namespace stepwright::config {

struct TlsAcceptorConfig {
  modbus::server::TcpOptions tcp;
  modbus::server::TlsOptions tls;
};

struct ModbusAcceptors {
  bool plain = true;  // Modbus TCP without TLS
  std::optional<TlsAcceptorConfig> tls;
  std::vector<modbus::server::LineOptions> lines;
};

// Reads them from the table [modbus.server]; relative paths are taken from `folder`. Who may come in
// (`plain_tcp.allow`) holds for TLS as well.
[[nodiscard]] result::Diagnostics read_modbus_acceptors(const settings::TomlTable& server,
                                                        const std::filesystem::path& folder,
                                                        const modbus::server::TcpOptions& plain_tcp,
                                                        const modbus::server::ServerOptions& options,
                                                        ModbusAcceptors& acceptors);

}  // namespace stepwright::config
