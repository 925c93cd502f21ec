#pragma once

// TLS around any other acceptor: whoever comes in there has to show a certificate first.
//
//   server.add(std::make_unique<TlsAcceptor>(std::move(tcp_acceptor), *TlsContext::create(...), on_refused));
//
// Allow-list, limits and socket options are the inner acceptor's. Threads: that of the server.

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "runtime/modbus/server/tls/tls_context.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

// Why a client was not let in: "192.168.1.7", "certificate has expired". For logs, whose rate is the log's to
// limit.
using OnRefused = std::function<void(const std::string& address, const std::string& reason)>;

class TlsAcceptor final : public Acceptor {
 public:
  TlsAcceptor(std::unique_ptr<Acceptor> inner, TlsContext context, OnRefused on_refused);

  // New connections use this context; open ones keep the one before.
  void renew(TlsContext context) { context_ = std::move(context); }
  const TlsContext& context() const { return context_; }

  int descriptor() const override { return inner_->descriptor(); }
  // The transport's peer() has the role of the certificate, and is authenticated.
  std::unique_ptr<Transport> admit() override;
  void turn_away() override { inner_->turn_away(); }
  std::uint64_t take_refused() override { return inner_->take_refused(); }
  std::string name() const override;  // "tls ..." for "tcp ..."

 private:
  std::unique_ptr<Acceptor> inner_;
  TlsContext context_;
  OnRefused on_refused_;
};

}  // namespace stepwright::modbus::server
