#pragma once

// The doors of the server as the configuration has them: plain TCP, TLS, serial lines.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "programs/config/modbus_server_config.h"
#include "programs/log/logger.h"
#include "runtime/modbus/server/tls/tls_door.h"
#include "runtime/modbus/server/transport.h"
#include "runtime/result/result.h"

namespace stepwright::modbus_server {

struct Doors {
  std::vector<std::unique_ptr<modbus::server::Door>> all;
  std::string names;                       // "tcp 127.0.0.1:502, tls 127.0.0.1:802"
  std::uint16_t port = 0;                  // of plain TCP; 0 without it
  modbus::server::TlsDoor* tls = nullptr;  // of `all`, wherever it moves; null without TLS
};

// Opens every door or none. A serial line may be missing: it is opened when it is there. What happens at the
// doors later goes to `log`, which must outlive them. Fails as TcpDoor::open and TlsContext::create do.
[[nodiscard]] result::Result<Doors> open_doors(const config::ModbusServerConfig& config, log::Logger& log);

}  // namespace stepwright::modbus_server
