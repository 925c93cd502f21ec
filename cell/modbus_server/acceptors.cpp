#include "cell/modbus_server/acceptors.h"

#include <utility>

#include "runtime/modbus/server/line/line_acceptor.h"
#include "runtime/modbus/server/tcp_acceptor.h"

namespace stepwright::modbus_server {
namespace {

using namespace modbus::server;

void add(std::unique_ptr<Acceptor> acceptor, Acceptors& acceptors) {
  acceptors.names += (acceptors.names.empty() ? "" : ", ") + acceptor->name();
  acceptors.all.push_back(std::move(acceptor));
}

result::Result<void> add_tls(const config::TlsAcceptorConfig& config, log::Logger& log,
                             Acceptors& acceptors) {
  auto context = TlsContext::create(config.tls);
  if (!context) return result::forward(context);
  auto inner = TcpAcceptor::open(config.tcp);
  if (!inner) return result::forward(inner);
  auto on_refused = [&log](const std::string& address, const std::string& reason) {
    log.warning("tls_refused", address + " was not let in: " + reason,
                {{"address", address}, {"reason", reason}});
  };
  auto acceptor = std::make_unique<TlsAcceptor>(std::move(*inner), std::move(*context), on_refused);
  acceptors.tls = acceptor.get();
  add(std::move(acceptor), acceptors);
  return {};
}

void add_line(const LineOptions& options, log::Logger& log, Acceptors& acceptors) {
  add(LineAcceptor::create(options,
                           [&log](const result::Diagnostics& problems) {
                             for (const result::Diagnostic& each : problems)
                               log.warning("line", result::to_string(each), {{"code", each.code}});
                           }),
      acceptors);
}

}  // namespace

result::Result<Acceptors> open_acceptors(const config::ModbusServerConfig& config, log::Logger& log) {
  Acceptors acceptors;
  if (config.acceptors.plain) {
    auto plain = TcpAcceptor::open(config.tcp);
    if (!plain) return result::forward(plain);
    acceptors.port = (*plain)->port();
    add(std::move(*plain), acceptors);
  }
  if (config.acceptors.tls) {
    auto added = add_tls(*config.acceptors.tls, log, acceptors);
    if (!added) return result::forward(added);
  }
  for (const LineOptions& line : config.acceptors.lines) add_line(line, log, acceptors);
  return acceptors;
}

}  // namespace stepwright::modbus_server
