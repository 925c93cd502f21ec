#pragma once

// The acceptors of the server as the configuration has them: plain TCP, TLS, serial lines.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cell/config/modbus_server_config.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/result/result.h"
#include "runtime/modbus/server/tls/tls_acceptor.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus_server {

struct Acceptors {
  std::vector<std::unique_ptr<modbus::server::Acceptor>> all;
  std::string names;                           // "tcp 127.0.0.1:502, tls 127.0.0.1:802"
  std::uint16_t port = 0;                      // of plain TCP; 0 without it
  modbus::server::TlsAcceptor* tls = nullptr;  // of `all`, wherever it moves; null without TLS
};

// Opens every acceptor or none. A serial line may be missing: it is opened when it is there. What happens at
// the acceptors later goes to `log`, which must outlive them. Fails as TcpAcceptor::open and
// TlsContext::create do.
[[nodiscard]] result::Result<Acceptors> open_acceptors(const config::ModbusServerConfig& config,
                                                       log::Logger& log);

}  // namespace stepwright::modbus_server
