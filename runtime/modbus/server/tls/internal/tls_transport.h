#pragma once

// One client behind TLS. It moves its bytes through the transport inside, so that it knows of no socket.
//
// Threads: that of the server. Nothing blocks: the handshake goes on with every read() and write().

#include <chrono>
#include <memory>
#include <string>

#include "runtime/modbus/server/tls/internal/native.h"
#include "runtime/modbus/server/tls/tls_acceptor.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

class TlsTransport final : public Transport {
 public:
  TlsTransport(std::unique_ptr<Transport> inner, const TlsContext& context, const OnRefused& on_refused);
  ~TlsTransport() override;

  int descriptor() const override { return inner_->descriptor(); }
  Moved read(std::span<std::byte> into) override;
  Moved write(std::span<const std::byte> from) override;
  bool needs_writable() const override { return needs_writable_; }
  bool has_buffered() const override;
  std::string address() const override { return inner_->address(); }
  const Peer* peer() const override { return ready_ ? &peer_ : nullptr; }

 private:
  // True when the handshake is through; else `waiting` says what to wait for.
  bool shake_hands(Moved& waiting);
  bool admit_peer();
  Moved after(int result, std::size_t bytes);
  Moved refuse(const std::string& reason);

  std::unique_ptr<Transport> inner_;
  TlsContext context_;  // outlives the connection
  const OnRefused& on_refused_;
  Ssl ssl_;
  Peer peer_;
  std::chrono::steady_clock::time_point begun_;
  bool needs_writable_ = false;
  bool ready_ = false;
  bool failed_ = false;
};

}  // namespace stepwright::modbus::server
