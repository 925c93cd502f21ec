#pragma once

// Identity of the server and the authorities that it believes: Modbus/TCP Security (MB-TCP-Security v2.1,
// port 802). TLS 1.2 or newer, both sides show certificates, no renegotiation, no resumption: every
// connection proves anew who it is and in which role.
//
//   auto context = TlsContext::create(
//       {.certificate = "plc.crt", .key = "plc.key", .authorities = "plant-ca.crt"});
//
// A value that is shared by the transports of an acceptor, each of which keeps the one that it began with.
// Threads: that of the server. OpenSSL's headers stay in the sources of this folder.

#include <chrono>
#include <filesystem>
#include <memory>

#include "runtime/ground/result/result.h"

namespace stepwright::modbus::server {

struct TlsOptions {
  std::filesystem::path
      certificate;            // of this server, PEM; the certificates up to the authority may follow it
  std::filesystem::path key;  // of the certificate, PEM, readable for nobody else
  std::filesystem::path authorities;  // PEM: whoever one of these has certified is let in
  std::filesystem::path revoked;      // PEM: revocation lists of the authorities; empty: none are looked at
  // A client that has not shown who it is by then is dropped.
  std::chrono::milliseconds handshake{5'000};
  result::Location where;  // of the settings, for diagnostics
};

class TlsContext {
 public:
  struct Native;

  // Fails with R0114 where a file cannot be read or holds nothing of its kind, R0115 where the key is not of
  // the certificate, R0116 where others of this machine may read the key.
  [[nodiscard]] static result::Result<TlsContext> create(const TlsOptions& options);

  const Native& native() const { return *native_; }
  // When the server's own certificate ends; nobody lets it in any more then.
  std::chrono::system_clock::time_point expires() const;
  std::chrono::milliseconds handshake() const { return handshake_; }

 private:
  TlsContext(std::shared_ptr<const Native> native, std::chrono::milliseconds handshake)
      : native_(std::move(native)), handshake_(handshake) {}

  std::shared_ptr<const Native> native_;
  std::chrono::milliseconds handshake_;
};

}  // namespace stepwright::modbus::server
