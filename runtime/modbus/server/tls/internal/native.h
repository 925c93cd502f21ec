#pragma once

// OpenSSL's objects with owners. For the sources of this folder only.

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <memory>
#include <string>

#include "runtime/modbus/server/tls/tls_context.h"

namespace stepwright::modbus::server {

template <typename Object, void (*kFree)(Object*)>
struct OpensslFree {
  void operator()(Object* object) const { kFree(object); }
};
template <typename Object, void (*kFree)(Object*)>
using Openssl = std::unique_ptr<Object, OpensslFree<Object, kFree>>;

using SslContext = Openssl<SSL_CTX, SSL_CTX_free>;
using Ssl = Openssl<SSL, SSL_free>;
using Certificate = Openssl<X509, X509_free>;

struct TlsContext::Native {
  SslContext context;
};

// The newest thing that OpenSSL complained about on this thread, and nothing that it said before.
inline std::string openssl_reason() {
  const unsigned long code = ERR_peek_last_error();
  const char* const text = code == 0 ? nullptr : ERR_reason_error_string(code);
  ERR_clear_error();
  return text == nullptr ? "unknown reason" : text;
}

}  // namespace stepwright::modbus::server
