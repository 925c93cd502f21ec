#include "cell/modbus_server/tls_reload.h"

#include <array>
#include <ctime>
#include <memory>
#include <utility>

namespace stepwright::modbus_server {

using modbus::server::TlsAcceptor;
using modbus::server::TlsContext;

std::string expiry_text(const TlsContext& context) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(context.expires());
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

config::ReloadPart tls_part(TlsAcceptor* acceptor, log::Logger& log) {
  if (acceptor == nullptr) return {};
  config::ReloadPart part;
  part.keys = {"modbus.server.tls.certificate", "modbus.server.tls.key", "modbus.server.tls.authorities",
               "modbus.server.tls.revoked"};
  // An acceptor that is to be closed stays as it is until the restart that closes it.
  part.applies = [](const config::CellConfig& wanted) {
    return wanted.modbus_server.acceptors.tls.has_value();
  };
  part.prepare = [acceptor, &log](const config::CellConfig& wanted) -> result::Result<std::function<void()>> {
    auto made = TlsContext::create(wanted.modbus_server.acceptors.tls->tls);
    if (!made) return result::forward(made);
    return [acceptor, &log, context = std::move(*made)] {
      acceptor->renew(context);
      const std::string until = expiry_text(context);
      log.info("tls", "certificate, key and authorities were read again: the certificate ends " + until,
               {{"expires", until}});
    };
  };
  return part;
}

}  // namespace stepwright::modbus_server
