#include "runtime/modbus/server/tls/tls_door.h"

#include <utility>

#include "runtime/modbus/server/tls/internal/tls_transport.h"

namespace stepwright::modbus::server {

TlsDoor::TlsDoor(std::unique_ptr<Door> inner, TlsContext context, OnRefused on_refused)
    : inner_(std::move(inner)), context_(std::move(context)), on_refused_(std::move(on_refused)) {}

std::unique_ptr<Transport> TlsDoor::admit() {
  auto inner = inner_->admit();
  if (!inner) return nullptr;
  return std::make_unique<TlsTransport>(std::move(inner), context_, on_refused_);
}

std::string TlsDoor::name() const {
  const std::string inner = inner_->name();
  return inner.starts_with("tcp ") ? "tls " + inner.substr(4) : "tls " + inner;
}

}  // namespace stepwright::modbus::server
