#pragma once

// New certificates for a server that runs: SIGHUP has the files of [modbus.server.tls] read again, the same
// or others. Connections that come from then on meet the new ones; those that are there go on. A file that is
// wrong refuses the whole reload, and everything stays as it was.
//
// Threads: the server's.

#include "cell/config/cell_config.h"
#include "cell/config/reload_log.h"
#include "runtime/ground/log/logger.h"
#include "runtime/modbus/server/tls/tls_acceptor.h"

namespace stepwright::modbus_server {

// For config::reload_log. `acceptor` may be null: the server has no TLS. Acceptor and log must outlive the
// part. Fails with R0114 to R0116.
config::ReloadPart tls_part(modbus::server::TlsAcceptor* acceptor, log::Logger& log);

// "2027-03-01T12:00:00Z"
std::string expiry_text(const modbus::server::TlsContext& context);

}  // namespace stepwright::modbus_server
