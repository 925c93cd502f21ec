#include "runtime/modbus/server/tls/tls_acceptor.h"

#include <utility>

#include "runtime/modbus/server/tls/internal/tls_transport.h"

namespace stepwright::modbus::server {

TlsAcceptor::TlsAcceptor(std::unique_ptr<Acceptor> inner, TlsContext context, OnRefused on_refused)
    : inner_(std::move(inner)), context_(std::move(context)), on_refused_(std::move(on_refused)) {}

std::unique_ptr<Transport> TlsAcceptor::admit() {
  auto inner = inner_->admit();
  if (!inner) return nullptr;
  return std::make_unique<TlsTransport>(std::move(inner), context_, on_refused_);
}

std::string TlsAcceptor::name() const {
  const std::string inner = inner_->name();
  return inner.starts_with("tcp ") ? "tls " + inner.substr(4) : "tls " + inner;
}

}  // namespace stepwright::modbus::server
